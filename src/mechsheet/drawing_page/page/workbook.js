// What is taken away: the workbook, pictures, the description; and the check of it.

import { ask, askFile } from "./asking.js";
import { LANGUAGES, called, word } from "./language.js";
import { on, state } from "./state.js";
import { say } from "./work.js";

const workbook = document.getElementById("workbook");
const wanted = { layout: "", language: "" };
const WISHES = { layout: ["", "sheets", "page"], language: ["", ...LANGUAGES] };
const FILES = ["xlsx", "ods", "svg", "png", "gif", "toml"];
const results = document.createElement("output");

function drawWorkbook() {
  workbook.replaceChildren();
  const row = () => {
    const made = document.createElement("div");
    made.className = "row";
    workbook.append(made);
    return made;
  };
  const button = (id, text, holder, act) => {
    const made = document.createElement("button");
    made.id = id;
    made.textContent = text;
    made.addEventListener("click", () => act(made));
    holder.append(made);
    return made;
  };
  const wishes = row();
  for (const [key, values] of Object.entries(WISHES)) {
    const list = document.createElement("select");
    list.setAttribute("aria-label", word(`workbook.${key}`));
    list.append(...values.map((value) => new Option(LANGUAGES.includes(value) ? called(value) : word(`workbook.${key}.${value || "own"}`), value)));
    list.value = wanted[key];
    list.addEventListener("change", () => (wanted[key] = list.value));
    wishes.append(list);
  }
  const files = row();
  for (const kind of FILES) {
    const made = button(`get-${kind}`, `.${kind}`, files, (pressed) => get(kind, pressed));
    made.title = word(`get.${kind}`);
    if (kind === "xlsx") made.className = "main";
  }
  button("check", word("check"), files, judge);
  results.id = "results";
  results.setAttribute("aria-live", "polite");
  workbook.append(results);
}

const what = (more) => ({ text: state.text, at: state.at, ...wanted, ...more });

async function get(kind, button) {
  button.disabled = true;
  try {
    const file = await askFile("file", what({ kind }));
    const anchor = document.createElement("a");
    anchor.href = URL.createObjectURL(file);
    anchor.download = `${(state.file.replace(/^.*\//, "").replace(/\.toml$/, "") || state.look?.name || "mechanism")}.${kind}`;
    anchor.click();
    setTimeout(() => URL.revokeObjectURL(anchor.href), 10000);
  } catch (error) {
    say(error.message);
    results.textContent = error.message;
  } finally {
    button.disabled = false;
  }
}

/** Check the workbook: first whether it is right, then what was compared, and what is to be said of the mechanism. */
async function judge(button) {
  button.disabled = true;
  results.textContent = word("check.running");
  try {
    show(await ask("check", what()));
  } catch (error) {
    results.textContent = error.message;
  } finally {
    button.disabled = false;
  }
}

function show({ agrees, verdict, judges, remarks }) {
  const line = (text, kind) => Object.assign(document.createElement("p"), { textContent: text, className: kind });
  const count = judges.reduce((sum, each) => sum + each.count, 0);
  const shown = [line(word(agrees ? "check.right" : "check.wrong", { count: count.toLocaleString(state.language) }), agrees ? "fine" : "wrong")];
  for (const { judge: name, agrees: alike, count: cells, where } of judges) {
    const text = word(alike ? "check.agrees" : "check.differs", { judge: word(`check.by.${name}`), count: cells.toLocaleString(state.language), where });
    shown.push(line(text, alike ? "part" : "wrong"));
  }
  shown.push(line(verdict, ""), ...remarks.map((each) => line(each, "wrong")));
  results.replaceChildren(...shown);
}

on("language", drawWorkbook);
