// What is done with the text: looked at, changed by orders of the drawing, undone, saved.

import { ask, Latest } from "./asking.js";
import { frameAt, places } from "./geometry.js";
import { word } from "./language.js";
import { after, before, changed, keep, remember, state } from "./state.js";
import { fit } from "./view.js";

/** Say something that is not the mechanism's: shown for a while over the drawing. */
export function say(text) {
  const place = document.getElementById("advice");
  place.textContent = text;
  place.dataset.said = text;
}

const question = () => ({ text: state.text, at: state.at, places: places(), velocities: state.velocities });

const looking = new Latest(async () => {
  const asked = question();
  try {
    const look = await ask("look", asked);
    if (asked.text === state.text) take(look, asked.at);
  } catch (error) {
    say(error.message);
  }
});

/** Ask what the text is, and show it. */
export const lookAgain = () => looking.run();

/** Show an answer. One that is no TOML leaves the drawing as it was; a position chosen since it was asked for stays. */
function take(look, askedAt) {
  const old = state.look;
  const first = !old?.frames || !Object.keys(old.frames.points).length;
  state.look = look.readable ? look : { ...(old ?? {}), ...look };
  if (look.readable) {
    const newer = state.at !== askedAt && look.solved;
    state.frame = newer ? frameAt(state.at) : look.at ?? 0;
    if (newer) state.at = look.frames.driver[state.frame];
  }
  if (!state.view || (first && Object.keys(look.frames?.points ?? {}).length > 1)) fit();
  changed("look", "frame");
  keep();
}

/** Another text: typed, or one that was undone. */
export function setText(text, at = state.at) {
  state.text = text;
  state.at = at;
  changed("text");
  keep();
  return lookAgain();
}

// --- orders -----------------------------------------------------------------------------------------------------------

let turn = Promise.resolve();

/** One after the other: each begins with the text that the one before has left. */
const inTurn = (task) => (turn = turn.then(task));

/** Change the text by an order of the drawing. The promise is false where it could not be done. */
export const order = (what) =>
  inTurn(async () => {
    const asked = question();
    try {
      const answer = await ask("edit", { ...asked, order: what });
      if (state.text !== asked.text) return false; // typed or undone meanwhile: that is newer
      remember();
      accept(answer, asked.at);
      return true;
    } catch (error) {
      say(error.message);
      return false;
    }
  });

/** Take over the text of an answer, and its position unless another one was chosen since it was asked for. */
function accept({ text, look }, askedAt) {
  state.text = text;
  const here = look.solved ? look.frames.driver[look.at] : askedAt;
  if (state.at === askedAt) state.at = askedAt = here;
  changed("text");
  take(look, askedAt);
}

/** A drag: every place is asked for from the text as it was before, and only the last one counts. */
export class Drag {
  constructor(point) {
    this.point = point;
    this.base = null; // text and places before it
    this.left = null; // text and position as the last answer has left them
    this.latest = new Latest((to) => inTurn(() => this.asked(to)));
  }

  to(place) {
    this.latest.run(place);
  }

  async asked(to) {
    this.base ??= this.left = question();
    try {
      const answer = await ask("edit", { ...this.base, order: { do: "move", point: this.point, to } });
      if (state.text !== this.left.text) return; // typed or undone meanwhile: that is newer
      if (this.left.text === this.base.text) remember();
      const chosen = state.at !== this.left.at;
      accept(answer, this.left.at);
      this.left = { text: state.text, at: chosen ? this.left.at : state.at };
    } catch (error) {
      say(error.message);
    }
  }
}

// --- undo and redo ----------------------------------------------------------------------------------------------------

export function undo() {
  const step = before();
  if (step) setText(step.text, step.at);
}

export function redo() {
  const step = after();
  if (step) setText(step.text, step.at);
}

// --- questions to the user --------------------------------------------------------------------------------------------

/** A question in the middle of the page; with `field` it asks for a text, with `choices` for one of several as
 * well ({ value, choice }). The answer is false or null where it is "no". */
export function confirmed(text, { yes, field = null, value = "", choices = null }) {
  const dialog = document.getElementById("ask");
  const input = document.getElementById("ask-input");
  document.getElementById("ask-text").textContent = text;
  document.getElementById("ask-yes").textContent = yes;
  document.getElementById("ask-no").textContent = word("cancel");
  document.getElementById("ask-field").hidden = field === null;
  document.getElementById("ask-label").textContent = field ?? "";
  input.value = value;
  const list = document.getElementById("ask-list");
  document.getElementById("ask-choice").hidden = choices === null;
  document.getElementById("ask-choice-label").textContent = choices?.label ?? "";
  list.replaceChildren(...(choices?.values ?? []).map(([key, words]) => new Option(words, key)));
  dialog.returnValue = "no";
  dialog.showModal();
  (field === null ? document.getElementById("ask-yes") : input).focus();
  if (field !== null) input.select();
  input.onkeydown = (event) => {
    if (event.key === "Enter") {
      event.preventDefault();
      dialog.close("yes");
    }
  };
  return new Promise((resolve) => {
    dialog.addEventListener(
      "close",
      () => {
        const agreed = dialog.returnValue === "yes";
        if (field === null) resolve(agreed);
        else if (!agreed) resolve(null);
        else resolve(choices ? { value: input.value, choice: list.value } : input.value);
      },
      { once: true },
    );
  });
}

/** Write the text to the file; asks where the file is not any more as it was. */
export async function save() {
  let name = "";
  if (!state.file) {
    name = await confirmed(word("save.as"), { yes: word("save"), field: word("save.name"), value: `${state.look?.name || "mechanism"}.toml` });
    if (!name) return;
  }
  const what = { text: state.text, mark: state.mark, name };
  try {
    let answer = await ask("save", what);
    if (!answer.saved) {
      if (!(await confirmed(word("save.changed", { file: answer.file }), { yes: word("save.replace") }))) return;
      answer = await ask("save", { ...what, replace: true });
    }
    Object.assign(state, { file: answer.file, mark: answer.mark, saved: what.text });
    changed("file");
    keep();
    say(word("save.done", { file: answer.file }));
  } catch (error) {
    say(error.message);
  }
}
