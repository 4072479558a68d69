// What is taken away: the workbook, pictures, the description; and the check of it.

import { ask, askFile } from "./asking.js";
import { word } from "./language.js";
import { on, state } from "./state.js";
import { say } from "./work.js";

const workbook = document.getElementById("workbook");
const wanted = { layout: "", language: "" };
const FILES = [["xlsx", "ods"], ["svg", "png", "gif", "toml"]];

function drawWorkbook() {
  workbook.replaceChildren();
  const choices = (key, values) => {
    const row = document.createElement("div");
    row.className = "row";
    row.setAttribute("role", "group");
    row.setAttribute("aria-label", word(`workbook.${key}`));
    for (const value of values) {
      const button = document.createElement("button");
      button.textContent = word(`workbook.${key}.${value || "own"}`);
      button.setAttribute("aria-pressed", String(wanted[key] === value));
      button.addEventListener("click", () => {
        wanted[key] = value;
        drawWorkbook();
      });
      row.append(button);
    }
    return row;
  };
  workbook.append(choices("layout", ["", "sheets", "page"]), choices("language", ["", "en", "tr"]));
  for (const group of FILES) {
    const row = document.createElement("div");
    row.className = "row";
    for (const kind of group) {
      const button = document.createElement("button");
      button.textContent = `.${kind}`;
      button.id = `get-${kind}`;
      button.className = kind === "xlsx" ? "main" : "";
      button.title = word(`get.${kind}`);
      button.addEventListener("click", () => get(kind, button));
      row.append(button);
    }
    workbook.append(row);
  }
  const check = document.createElement("button");
  check.id = "check";
  check.textContent = word("check");
  check.addEventListener("click", () => judge(check));
  const results = document.createElement("output");
  results.id = "results";
  results.setAttribute("aria-live", "polite");
  workbook.append(check, results);
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
    document.getElementById("results").textContent = error.message;
  } finally {
    button.disabled = false;
  }
}

async function judge(button) {
  const results = document.getElementById("results");
  button.disabled = true;
  results.textContent = word("check.running");
  try {
    const { lines } = await ask("check", what());
    results.textContent = lines.join("\n");
  } catch (error) {
    results.textContent = error.message;
  } finally {
    button.disabled = false;
  }
}

on("language", drawWorkbook);
