// The page begins: what was kept in this tab, or the file that the command named.

import { ask } from "./asking.js";
import { LANGUAGES, label, next, note, word } from "./language.js";
import "./scene.js";
import "./motion.js";
import "./textpane.js";
import "./panels.js";
import "./pointers.js";
import "./keyboard.js";
import { changed, keep, kept, on, redoable, remember, state, undoable } from "./state.js";
import { fit, zoom } from "./view.js";
import { confirmed, lookAgain, redo, save, setText, undo } from "./work.js";

const get = (id) => document.getElementById(id);
let templates = {}; // name -> title in every language

async function begin() {
  const given = await ask("begin");
  const mine = kept();
  if (mine) Object.assign(state, mine);
  else {
    Object.assign(state, { text: given.text || given.empty, file: given.file, mark: given.mark });
    state.saved = given.text;
    state.language = given.language || (LANGUAGES.find((each) => navigator.language.startsWith(each)) ?? "en");
    state.theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
  }
  templates = given.templates;
  changed("theme", "language", "file", "grid", "paths", "velocities", "picture", "tool");
  changed("text");
  if (state.view) changed("view");
  await lookAgain();
  document.body.dataset.ready = "yes";
  stay();
}

/** As long as this stream is open the program knows that the page is. */
function stay() {
  const stream = new EventSource("open");
  stream.onopen = () => (get("gone").hidden = true);
  stream.onerror = () => {
    get("gone").textContent = word("gone");
    get("gone").hidden = false;
  };
}

// --- the bar ----------------------------------------------------------------------------------------------------------

get("undo").addEventListener("click", undo);
get("redo").addEventListener("click", redo);
get("save").addEventListener("click", save);
get("fit").addEventListener("click", fit);
get("nearer").addEventListener("click", () => zoom(1.25));
get("farther").addEventListener("click", () => zoom(0.8));
get("help-button").addEventListener("click", help);
for (const name of ["grid", "paths", "velocities"]) {
  get(name).addEventListener("click", () => {
    state[name] = !state[name];
    changed(name);
    keep();
    if (name === "velocities") lookAgain();
  });
  on(name, () => get(name).setAttribute("aria-pressed", String(state[name])));
}
get("language").addEventListener("click", () => {
  state.language = next();
  changed("language");
  lookAgain();
});
get("theme").addEventListener("click", () => {
  state.theme = state.theme === "light" ? "dark" : "light";
  changed("theme");
  keep();
});
get("templates").addEventListener("change", async (event) => {
  const name = event.target.value;
  event.target.value = "";
  if (!name) return;
  if (state.text.trim() !== state.saved.trim() && !(await confirmed(word("template.replace"), { yes: word("template.take") }))) return;
  const { text } = await ask("template", { name });
  remember();
  state.view = null;
  state.curves = null;
  setText(text, null);
});

on("theme", () => (document.documentElement.dataset.theme = state.theme));
on("language", () => {
  const options = Object.entries(templates).map(([name, title]) => new Option(title[state.language], name));
  get("templates").replaceChildren(new Option(word("template"), ""), ...options);
  label();
});

const stem = (file) => file.split("/").pop().replace(/\.toml$/, "");

function bar() {
  const unsaved = state.text !== state.saved;
  get("undo").disabled = !undoable();
  get("redo").disabled = !redoable();
  get("file").title = state.file;
  get("file").textContent = `${state.file.split("/").pop() || word("file.none")}${unsaved && state.file ? ` · ${word("file.unsaved")}` : ""}`;
  get("title").textContent = state.look?.title || state.look?.name || (state.look ? word("title") : stem(state.file));
  document.title = `${unsaved ? "• " : ""}${state.look?.name || "mechsheet"} – draw`;
}
on("text look file language", bar);

function help() {
  const steps = document.createElement("ol");
  for (const step of [1, 2, 3, 4]) steps.append(Object.assign(document.createElement("li"), { textContent: word(`help.first.${step}`) }));
  const heading = (key) => Object.assign(document.createElement("h3"), { textContent: word(key) });
  const list = document.createElement("dl");
  for (const key of ["tools", "arrows", "enter", "delete", "rename", "space", "undo", "save", "zoom", "alt"]) {
    const head = document.createElement("dt");
    const text = document.createElement("dd");
    head.textContent = word(`help.${key}.keys`);
    text.textContent = word(`help.${key}`);
    list.append(head, text);
  }
  get("help-text").replaceChildren(heading("help.first"), steps, note(word("help.assembly")), heading("help.keys"), list);
  get("help").showModal();
  get("help").scrollTop = 0; // its button, which has the focus, is at the end
}

document.addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey)) return;
  const key = event.key.toLowerCase();
  const own = event.target.tagName === "INPUT";
  if (key === "s") save();
  else if (own) return;
  else if (key === "z" && !event.shiftKey) undo();
  else if (key === "y" || (key === "z" && event.shiftKey)) redo();
  else return;
  event.preventDefault();
});
addEventListener("beforeunload", keep);

begin();
