// What is not drawn but written: a motion law, masses for all links; the program writes it into the text with the names of the drawing.

import { word } from "./language.js";
import { on, state } from "./state.js";
import { goTo } from "./textpane.js";
import { order, say } from "./work.js";

const KINDS = ["motion", "masses"];
const menu = document.getElementById("insert");

/** The first and the last line that are new in `after`, counted from 1, without empty lines around them. */
function changedLines(before, after) {
  const [old, now] = [before.split("\n"), after.split("\n")];
  let first = 0;
  while (first < now.length && old[first] === now[first]) first++;
  let behind = 0;
  while (behind < now.length - first && behind < old.length - first && old[old.length - 1 - behind] === now[now.length - 1 - behind]) behind++;
  let last = now.length - behind;
  while (first < last - 1 && !now[first].trim()) first++;
  while (last > first + 1 && !now[last - 1].trim()) last--;
  return [first + 1, last];
}

async function insert(what) {
  const before = state.text;
  if (!(await order({ do: "insert", what }))) return;
  const [first, last] = changedLines(before, state.text);
  goTo(first);
  say(word("insert.done", { first, last }));
}

menu.addEventListener("change", () => {
  const what = menu.value;
  menu.value = "";
  if (what) insert(what);
});

on("language", () => {
  menu.replaceChildren(new Option(word("insert"), ""), ...KINDS.map((kind) => new Option(word(`insert.${kind}`), kind)));
});
