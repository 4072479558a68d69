// The dimensions and the sweep of the driver: numbers that are typed, and those that follow from them.

import { escaped, greek, shown, symbol } from "./geometry.js";
import { note, word } from "./language.js";
import { on, state } from "./state.js";
import { order } from "./work.js";

const dimensions = document.getElementById("dimensions");
let table = "";

/** A number that can be typed over; `kind`: by which order. */
function field(name, value, label, kind = "dimension") {
  const input = document.createElement("input");
  input.type = "text";
  input.inputMode = "decimal";
  input.value = typable(value);
  input.dataset.name = name;
  input.dataset.kind = kind;
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

const typable = (value) => (value === null ? "" : shown(value, 8).replace("−", "-"));

async function type(input) {
  const name = input.dataset.name;
  const done = await order({ do: input.dataset.kind, name, value: input.value });
  const now = dimensions.querySelector(`[data-name="${CSS.escape(name)}"]`);
  now?.classList.toggle("bad", !done);
  if (done && now?.value === input.value) refreshAll(true); // what was typed with its unit is now a number in the cell's own
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
  const cells = look?.cells ?? [];
  const now = JSON.stringify([cells.map((each) => [each.place, each.unit]), listed.map((each) => [each.symbol, each.unit, each.label, each.formula]), Object.keys(sweep), look?.undrawn, state.language, look?.driver?.symbol]);
  if (now === table) {
    refreshAll(false);
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
    const head = note(`${word("driver")} ${greek(look.driver.symbol)}`);
    head.className = "part";
    const more = document.createElement("table");
    for (const [key, value] of Object.entries(sweep)) {
      more.append(rowOf(word(`sweep.${key}`), field(`driver.${key}`, value, word(`sweep.${key}`)), escaped(look.driver.unit), ""));
    }
    dimensions.append(head, more);
  }
  if (cells.length) {
    const head = note(word("cells"));
    head.className = "part";
    const more = document.createElement("table");
    for (const { place, symbol: name, value, unit, label } of cells) {
      const said = label || word("cells.speed");
      more.append(rowOf(symbol(name), field(place, value, said, "cell"), escaped(unit), escaped(said)));
    }
    dimensions.append(head, more);
  }
  if (look?.undrawn?.length) {
    dimensions.append(note(`${word("undrawn")} ${look.undrawn.map((key) => word(`undrawn.${key}`)).join(", ")}.`));
  }
}

/** The numbers as they are now; a field in which somebody types is left alone, unless `typed` says it is done. */
function refreshAll(typed) {
  const { dimensions: listed = [], driver, cells = [] } = state.look;
  for (const { symbol: name, value, formula } of listed) refresh(name, value, formula, typed);
  for (const [key, value] of Object.entries(driver?.sweep ?? {})) refresh(`driver.${key}`, value, "", typed);
  for (const { place, value } of cells) refresh(place, value, "", typed);
}

function refresh(name, value, formula, typed) {
  const cell = dimensions.querySelector(`[data-name="${CSS.escape(name)}"]`);
  if (!cell || (cell === document.activeElement && !typed)) return;
  const text = formula ? shown(value) : typable(value);
  if ("value" in cell && cell.value !== text) cell.value = text;
}

on("look language", drawDimensions);
