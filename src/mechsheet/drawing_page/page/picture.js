// A picture behind the drawing: a photo, or the figure of a textbook, scaled by two clicks on a known length.

import { ask } from "./asking.js";
import { distance, shown } from "./geometry.js";
import { word } from "./language.js";
import { changed, keep, on, state } from "./state.js";
import { size, toPlane } from "./view.js";
import { confirmed, say } from "./work.js";

const LARGEST = 1600; // pixels: what is kept for a reload must be small

const box = document.getElementById("picture-box");
const button = document.getElementById("picture");
const strength = document.getElementById("picture-strength");

/** The picture in a bearable size, as a data address. */
async function read(file) {
  const bitmap = await createImageBitmap(file);
  const part = Math.min(1, LARGEST / Math.max(bitmap.width, bitmap.height));
  const sheet = document.createElement("canvas");
  sheet.width = Math.max(1, Math.round(bitmap.width * part));
  sheet.height = Math.max(1, Math.round(bitmap.height * part));
  sheet.getContext("2d").drawImage(bitmap, 0, 0, sheet.width, sheet.height);
  return { url: sheet.toDataURL("image/jpeg", 0.85), ratio: bitmap.height / bitmap.width };
}

document.getElementById("picture-file").addEventListener("change", async (event) => {
  const [file] = event.target.files;
  event.target.value = "";
  if (!file) return;
  try {
    const { url, ratio } = await read(file);
    const [left, top] = toPlane(size().width * 0.1, size().height * 0.1);
    const [right] = toPlane(size().width * 0.9, 0);
    const width = right - left;
    state.picture = { url, x: left, y: top, width, height: width * ratio, strength: Number(strength.value) };
    changed("picture");
    keep();
    say(word("picture.there"));
  } catch {
    say(word("picture.unreadable"));
  }
});

/** Make the distance of two places as long as the user says; the first one stays where it is. */
export async function scalePicture(first, second) {
  const there = distance(first, second);
  if (!state.picture || !there) return;
  const answer = await confirmed(word("picture.length"), { yes: word("picture.scale"), field: state.look?.unit ?? "", value: shown(there, 4) });
  if (answer === null) return;
  let length = 0;
  try {
    ({ length } = await ask("length", { text: state.text, value: answer }));
  } catch (error) {
    say(error.message);
  }
  if (!(length > 0)) return;
  const factor = length / there;
  const { x, y, width, height } = state.picture;
  Object.assign(state.picture, {
    x: first[0] + (x - first[0]) * factor,
    y: first[1] + (y - first[1]) * factor,
    width: width * factor,
    height: height * factor,
  });
  changed("picture");
  keep();
}

button.addEventListener("click", () => {
  box.hidden = !box.hidden;
  button.setAttribute("aria-expanded", String(!box.hidden));
});
document.getElementById("picture-scale").addEventListener("click", () => {
  if (!state.picture) return;
  state.tool = "scale";
  changed("tool");
  document.getElementById("canvas").focus();
});
strength.addEventListener("input", () => {
  if (!state.picture) return;
  state.picture.strength = Number(strength.value);
  changed("picture");
  keep();
});
document.getElementById("picture-away").addEventListener("click", () => {
  state.picture = null;
  changed("picture");
  keep();
});
on("picture", () => {
  for (const name of ["picture-scale", "picture-strength", "picture-away"]) document.getElementById(name).disabled = !state.picture;
});
