from itertools import combinations

import numpy as np
import pytest

from plyfold.colours import INK, PAPER, SHEETS, layer_colour, rgb, sheet_colour, text_colour, winding_colour

# Full loss of one cone type, in linear RGB: Machado, Oliveira, Fernandes, "A Physiologically-based Model for
# Simulation of Color Vision Deficiency", 2009, table 1, severity 1.0.
EYES = {
    "all cones": np.eye(3),
    "protanopia": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deuteranopia": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritanopia": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}
TO_XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])


def linear(colour):
    channels = np.array(rgb(colour))
    return np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)


def lab(colour, eye):
    x, y, z = TO_XYZ @ np.clip(np.array(eye) @ linear(colour), 0, 1) / TO_XYZ.sum(axis=1)
    f = [np.cbrt(t) if t > 0.008856 else 7.787 * t + 16 / 116 for t in (x, y, z)]
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def contrast(first, second):
    low, high = sorted(float((TO_XYZ @ linear(c))[1]) for c in (first, second))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("eye", EYES)
def test_sheets_stay_apart_for_every_eye(eye):
    for first, second in combinations(SHEETS, 2):
        difference = np.linalg.norm(lab(first, EYES[eye]) - lab(second, EYES[eye]))
        assert difference > 10, (first, second)  # 2.3 is just noticeable


def test_sheet_colours_repeat_only_after_three_rounds():
    colours = [sheet_colour(i) for i in range(3 * len(SHEETS))]
    assert len(set(colours)) == len(colours)
    assert sheet_colour(3 * len(SHEETS)) == colours[0]


@pytest.mark.parametrize("sign", [1, -1])
def test_winding_colours_darken_with_the_number(sign):
    lightness = [lab(winding_colour(sign * w), np.eye(3))[0] for w in range(6 if sign < 0 else 7)]
    assert (np.diff(lightness) < -5).all()


def test_negative_winding_is_red_and_positive_is_blue():
    for winding in range(1, 10):
        red, _, blue = rgb(winding_colour(-winding))
        assert red > blue
        red, _, blue = rgb(winding_colour(winding))
        assert blue > red


def test_numbers_can_be_read_on_every_winding_colour():
    for winding in range(-9, 10):
        background = winding_colour(winding)
        assert contrast(text_colour(background), background) > 3.5
        assert text_colour(background) in (INK, PAPER)


def test_layers_brighten_upwards():
    lightness = [lab(layer_colour(level, 5), np.eye(3))[0] for level in range(1, 6)]
    assert (np.diff(lightness) > 5).all()
