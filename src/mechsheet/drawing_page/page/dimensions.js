// The dimensions and the sweep of the driver: numbers that are typed, and those that follow from them.

import { escaped, shown, symbol } from "./geometry.js";
import { note, word } from "./language.js";
import { on, state } from "./state.js";
import { order } from "./work.js";

const dimensions = document.getElementById("dimensions");
let table = "";

function field(name, value, label) {
  const input = document.createElement("input");
  input.type = "text";
  input.inputMode = "decimal";
  input.value = shown(value, 8).replace("−", "-");
  input.dataset.name = name;
  input.setAttribute("aria-label", label);
  input.addEventListener("change", () => type(input));
  input.addEventListener("keydown", (event) => {
    const step = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    const now = Number(input.value);
    if (!step || !Number.isFinite(now)) return;
    event.preventDefault();
    const by = 10 ** Math.floor(Math.log10(Math.abs(now) || 1) - 1) * (event.shiftKey ? 10 : 1);
    input.value = String(Number((now + step * by).toPrecision(10)));
    type(input);
  });
  return input;
}

async function type(input) {
  const name = input.dataset.name;
  const done = await order({ do: "dimension", name, value: input.value });
  const now = dimensions.querySelector(`[data-name="${CSS.escape(name)}"]`);
  now?.classList.toggle("bad", !done);
}

function rowOf(head, value, unit, label) {
  const row = document.createElement("tr");
  for (const content of [head, value, unit, label]) {
    const cell = document.createElement("td");
    if (content instanceof Node) cell.append(content);
    else cell.innerHTML = content;
    row.append(cell);
  }
  row.lastChild.className = "of";
  return row;
}

function drawDimensions() {
  if (!state.look) return;
  const look = state.look;
  const listed = look?.dimensions ?? [];
  const sweep = look?.driver?.sweep ?? {};
  const now = JSON.stringify([listed.map((each) => [each.symbol, each.unit, each.label, each.formula]), Object.keys(sweep), look?.undrawn, state.language, look?.driver?.symbol]);
  if (now === table) {
    for (const { symbol: name, value, formula } of listed) refresh(name, value, formula);
    for (const [key, value] of Object.entries(sweep)) refresh(`driver.${key}`, value, "");
    return;
  }
  table = now;
  dimensions.replaceChildren();
  const rows = document.createElement("table");
  for (const { symbol: name, value, unit, label, formula } of listed) {
    const said = label || name;
    const cell = formula ? document.createElement("output") : field(name, value, said);
    if (formula) {
      cell.textContent = shown(value);
      cell.dataset.name = name;
      cell.title = formula;
    }
    rows.append(rowOf(symbol(name), cell, escaped(unit), escaped(label)));
  }
  if (listed.length) dimensions.append(rows);
  else dimensions.append(note(word("dimensions.none")));
  if (Object.keys(sweep).length) {
    const head = note(`${word("driver")} ${look.driver.symbol.replace("theta", "θ")}`);
    head.className = "part";
    const more = document.createElement("table");
    for (const [key, value] of Object.entries(sweep)) {
      more.append(rowOf(word(`sweep.${key}`), field(`driver.${key}`, value, word(`sweep.${key}`)), escaped(look.driver.unit), ""));
    }
    dimensions.append(head, more);
  }
  if (look?.undrawn?.length) {
    dimensions.append(note(`${word("undrawn")} ${look.undrawn.map((key) => word(`undrawn.${key}`)).join(", ")}.`));
  }
}

function refresh(name, value, formula) {
  const cell = dimensions.querySelector(`[data-name="${CSS.escape(name)}"]`);
  if (!cell || cell === document.activeElement) return;
  const text = formula ? shown(value) : shown(value, 8).replace("−", "-");
  if ("value" in cell && cell.value !== text) cell.value = text;
}

on("look language", drawDimensions);
