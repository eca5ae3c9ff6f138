"""Offers take as long as they need: no test depends on how fast the machine is."""

import pytest


@pytest.fixture(autouse=True)
def patient_offers(monkeypatch):
    monkeypatch.setattr("plyfold.report._SECONDS_FOR_OFFERS", 60.0)
