// What is done with the text: looked at, changed by orders of the drawing, undone, saved.

import { ask, Latest } from "./asking.js";
import { places } from "./geometry.js";
import { word } from "./language.js";
import { after, before, changed, keep, remember, state } from "./state.js";
import { fit } from "./view.js";

/** Say something that is not the mechanism's: shown for a while over the drawing. */
export function say(text) {
  const place = document.getElementById("advice");
  place.textContent = text;
  place.dataset.said = text;
}

const question = () => ({ text: state.text, at: state.at, places: places(), language: state.language });

const looking = new Latest(async () => {
  const text = state.text;
  try {
    const look = await ask("look", question());
    if (text === state.text) take(look);
  } catch (error) {
    say(error.message);
  }
});

/** Ask what the text is, and show it. */
export const lookAgain = () => looking.run();

/** Show an answer. One that is no TOML leaves the drawing as it was. */
export function take(look) {
  const old = state.look;
  const first = !old?.frames || !Object.keys(old.frames.points).length;
  state.look = look.readable ? look : { ...(old ?? {}), ...look };
  if (look.readable) state.frame = Math.min(look.at ?? 0, (look.frames?.driver?.length ?? 1) - 1);
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

/** Change the text by an order of the drawing. The promise is false where it could not be done. */
export async function order(what) {
  try {
    const answer = await ask("edit", { ...question(), order: what });
    remember();
    accept(answer);
    return true;
  } catch (error) {
    say(error.message);
    return false;
  }
}

function accept(answer) {
  state.text = answer.text;
  state.at = answer.look.frames && answer.look.solved ? answer.look.frames.driver[answer.look.at] : state.at;
  changed("text");
  take(answer.look);
}

/** A drag: every place is asked for from the text as it was before, and only the last one counts. */
export class Drag {
  constructor(point) {
    this.point = point;
    this.base = question();
    this.begun = false;
    this.latest = new Latest(async (to) => {
      try {
        const answer = await ask("edit", { ...this.base, order: { do: "move", point, to } });
        if (!this.begun) remember();
        this.begun = true;
        accept(answer);
      } catch (error) {
        say(error.message);
      }
    });
  }

  to(place) {
    this.latest.run(place);
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

/** A question in the middle of the page; with `field` it asks for a text. The answer is false or null where it is "no". */
export function confirmed(text, { yes, field = null, value = "" }) {
  const dialog = document.getElementById("ask");
  const input = document.getElementById("ask-input");
  document.getElementById("ask-text").textContent = text;
  document.getElementById("ask-yes").textContent = yes;
  document.getElementById("ask-no").textContent = word("cancel");
  document.getElementById("ask-field").hidden = field === null;
  document.getElementById("ask-label").textContent = field ?? "";
  input.value = value;
  dialog.returnValue = "no";
  dialog.showModal();
  (field === null ? document.getElementById("ask-yes") : input).focus();
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
        resolve(field === null ? agreed : agreed ? input.value : null);
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
    Object.assign(state, { file: answer.file, mark: answer.mark, saved: state.text });
    changed("file");
    keep();
    say(word("save.done", { file: answer.file }));
  } catch (error) {
    say(error.message);
  }
}
