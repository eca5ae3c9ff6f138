// The verdict in words, the figures, and the walks through immersions and layerings.

import { actionNamed } from "./actions.js";
import { SILENT } from "./answers.js";
import { button } from "./buttons.js";
import { isEmpty } from "./document.js";
import { previewing } from "./offers.js";
import { notesOf, spikesNote } from "./notes.js";
import { answerShown, errorShown, lieShown, offerOf, ribbonShown, shown, touchesShown } from "./store.js";
import { counted } from "./wording.js";

const HEADLINES = { unfinished: "Not a loop yet", away: SILENT };
const LONGEST = 600;
const REMEDIES = ["holes", "ribbon", "closeLoop", "lastOnly"];
const find = (id) => document.getElementById(id);
const grouped = (digits) => (digits.length > 24 ? `about 10^${digits.length - 1}` : digits.replace(/\B(?=(\d{3})+$)/g, ","));

/** What is known, in one headline and one sentence. `state` colours it. */
export function verdictOf(state) {
  const error = errorShown(state);
  if (isEmpty(shown(state))) return { kind: "empty", headline: "", sentence: "" };
  if (error) return { kind: "unfinished", headline: HEADLINES[error.kind] ?? "Not a loop that can be used", sentence: [told(error), tooTight(state)].filter(Boolean).join(" ") };
  const answer = answerShown(state);
  if (!answer) return null;
  const lie = lieShown(state);
  const kind = kindOf(answer.verdict, lie, touchesShown(state));
  const { headline, sentence } = (lie ?? answer).verdict;
  const said = offerOf(state, state.previewed)?.sentence ?? [sentence, spikesNote(answer), tooTight(state)].filter(Boolean).join(" ");
  return { kind, headline, sentence: said };
}

const told = ({ sentence, hint }) => sentenceCase(`${sentence}${hint ? `: ${hint}` : ""}.`);

/** Why ribbons of this width cannot be made. */
function tooTight(state) {
  const error = ribbonShown(state)?.error;
  return error ? told(error) : "";
}

function kindOf({ immersible }, lie, touches) {
  if (!immersible) return immersible === null ? "undecided" : "no";
  if (lie?.obstruction) return "unlifted";
  return touches.length ? "touching" : "yes";
}

export function figuresOf(state) {
  const answer = answerShown(state);
  if (!answer) return [];
  const lie = lieShown(state);
  const rows = [
    ...(answer.loops.length > 1 ? [["loops", String(answer.loops.length)]] : []),
    ["crossings", String(answer.crossings_as_given)],
    ...(answer.contacts.length ? [["crossings when moved apart", String(answer.crossings.length)]] : []),
    ...(answer.cusps.length ? [["cusps", counted(answer.cusps.map(({ index }) => `index ${index}`))]] : []),
    turningOf(answer),
    ["cells by winding number", windings(answer.cells_by_winding)],
    ...answer.verdict.figures,
    ["immersions", answer.verdict.immersions === null ? "more than could be counted" : grouped(answer.verdict.immersions)],
  ];
  const touches = touchesShown(state);
  if (touches.length) {
    rows.push(["touches itself at", touches.map((place) => `(${place.map(rounded).join(", ")})`).join(", ")]);
    rows.push(["cut there", (lie ?? answer.verdict).cut]);
  }
  const notes = notesOf(answer);
  if (notes) rows.push(["notes", notes]);
  if (lie?.levels) rows.push(["levels", String(Math.max(0, ...answer.cells_by_winding.map(([winding]) => winding)))]);
  const moved = answer.contacts.length ? " when moved apart" : "";
  if (answer.gauss) rows.push([`Gauss code${moved}`, answer.gauss]);
  if (answer.word) rows.push([`Blank's word${moved}`, answer.word]);
  return rows;
}

function turningOf({ turning_numbers: numbers, reversed: wasTurned }) {
  if (numbers.length > 1) return ["turning numbers", numbers.map(minus).join(", ") + (wasTurned ? " (turned round)" : "")];
  return ["turning number", minus(numbers[0]) + (wasTurned ? " (drawn clockwise)" : "")];
}

const rounded = (number) => minus(Number(number.toPrecision(6)));
const minus = (number) => String(number).replace("-", "−");

/** As much of a long code as is read; the copy has the whole. */
const readable = (value) => (value.length > LONGEST ? `${value.slice(0, LONGEST)} …` : value);

const windings = (counts) => counts.map(([winding, count]) => `${count} with ${winding}`.replace("-", "−")).join(", ");

/** The answers as text, one to a line. */
export function answersAsText(state) {
  const verdict = verdictOf(state);
  const lie = lieShown(state);
  const walks = lie ? [["immersion", placeOf(lie, "immersion")], ["layering", placeOf(lie, "layering")]] : [];
  const lines = [...figuresOf(state), ...walks].filter(([, value]) => value).map(([name, value]) => `${name}: ${value}`);
  return [verdict?.headline, verdict?.sentence, ...lines].filter(Boolean).join("\n");
}

function placeOf(lie, kind) {
  const count = lie[`${kind}s`];
  if (kind === "layering" && !lie.layerable) return "";
  return `${grouped(String(BigInt(lie[kind]) + 1n))} of ${count === null ? "more than could be counted" : grouped(count)}`;
}

// ---- the page -----------------------------------------------------------------------------------------------------

export function createPanel(page) {
  walkBar(page, "immersion", "previousImmersion", "nextImmersion");
  walkBar(page, "layering", "layeringDown", "layeringUp");
  const remedies = find("remedies");
  const buttons = REMEDIES.map((name) => button(page, actionNamed(name)));
  remedies.prepend(...buttons);
  buttons.filter(({ dataset }) => actionNamed(dataset.action).preview).forEach((made) => previewing(page, made));
  page.store.follow((state, before) => {
    if (state !== before) refresh(state);
  });
  refresh(page.store.state);
}

function walkBar(page, kind, back, on) {
  const bar = find(`walk-${kind}`);
  const text = Object.assign(document.createElement("output"), { id: `${kind}-text` });
  text.setAttribute("aria-live", "polite");
  bar.append(button(page, actionNamed(back), { label: false }), text, button(page, actionNamed(on), { label: false }));
  const arrows = kind === "immersion" ? ["←", "→"] : ["↓", "↑"];
  [...bar.querySelectorAll("button")].forEach((made, i) => made.prepend(arrows[i]));
}

function refresh(state) {
  const verdict = verdictOf(state);
  if (verdict) {
    find("verdict").parentElement.dataset.state = verdict.kind;
    write(find("verdict"), verdict.headline);
    write(find("sentence"), sentenceCase(verdict.sentence));
  }
  document.body.classList.toggle("asking", state.asking);
  find("invitation").hidden = !isEmpty(shown(state)) || state.path.length > 0 || state.cursor !== null;
  write(find("name"), state.name ?? "");
  const lie = lieShown(state);
  for (const kind of ["immersion", "layering"]) {
    const place = lie ? placeOf(lie, kind) : "";
    write(find(`${kind}-text`), place ? `${kind} ${place}` : kind);
  }
  refreshFigures(figuresOf(state));
}

const sentenceCase = (sentence) => signed(sentence.replace(/^./, (letter) => letter.toUpperCase()));

/** With true minus signs before numbers. */
const signed = (text) => text.replace(/(?<![\w-])-(?=\d)/g, "−");

function write(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

let written = "";

function refreshFigures(rows) {
  const text = JSON.stringify(rows);
  if (text === written) return;
  written = text;
  find("figures").replaceChildren(...rows.map(([name, value]) => {
    const row = document.createElement("div");
    row.append(Object.assign(document.createElement("dt"), { textContent: name }), Object.assign(document.createElement("dd"), { textContent: readable(value) }));
    return row;
  }));
}
