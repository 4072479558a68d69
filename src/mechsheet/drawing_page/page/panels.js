// What is beside and below the drawing: dimensions, freedoms and faults, curves, the workbook.

import { ask, askFile } from "./asking.js";
import { escaped, shown, symbol } from "./geometry.js";
import { word } from "./language.js";
import { show } from "./motion.js";
import { changed, keep, on, state } from "./state.js";
import { goTo, told } from "./textpane.js";
import { order, say } from "./work.js";

// --- dimensions -------------------------------------------------------------------------------------------------------

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

function note(text) {
  const made = document.createElement("p");
  made.className = "note";
  made.textContent = text;
  return made;
}

// --- freedoms and faults ----------------------------------------------------------------------------------------------

const freedom = document.getElementById("freedom");
const verdict = document.getElementById("verdict");
const faults = document.getElementById("faults");

function drawState() {
  const look = state.look;
  const count = look?.mobility;
  freedom.hidden = count === null || count === undefined;
  freedom.textContent = word("freedom", { count });
  freedom.className = look?.solved ? "fine" : "amber";
  const closed = look?.frames?.why?.filter((each) => !each).length ?? 0;
  const all = look?.frames?.why?.length ?? 0;
  const reason = look?.frames?.reasons?.[look.frames.why?.[state.frame] ?? 0];
  let text = "";
  if (look && !look.readable) text = word("state.broken");
  else if (look?.solved && reason?.text) text = `${word("state.here")} ${reason.text}`;
  else if (look?.solved && closed === all) text = word("state.all");
  else if (look?.solved) {
    const missing = look.frames.reasons.slice(1).map((each) => each.text).join("; ");
    text = `${word("state.some")} ${stretches(look.frames)} (${missing})`;
  }
  else if ((look?.links ?? []).length > 1) text = word("state.unfinished");
  verdict.textContent = text;
  verdict.className = reason?.text || (look && !look.readable) ? "wrong" : "";
}

/** Where it closes: from … to …; between two positions the limit is known better than by them. */
function stretches({ driver, why }) {
  const limits = state.look.limits ?? [];
  const [first, last] = [Math.min(driver[0], driver[driver.length - 1]), Math.max(driver[0], driver[driver.length - 1])];
  const near = (n, beside) => {
    const [a, b] = [driver[n], driver[beside] ?? driver[n]];
    return limits.find((limit) => limit >= Math.min(a, b) && limit <= Math.max(a, b) && limit >= first && limit <= last) ?? a;
  };
  const found = [];
  for (let n = 0; n < why.length; n++) {
    if (why[n]) continue;
    let end = n;
    while (end + 1 < why.length && !why[end + 1]) end++;
    found.push(`${shown(near(n, n - 1), 5)}…${shown(near(end, end + 1), 5)}${state.look.driver?.unit ?? ""}`);
    n = end;
  }
  return found.slice(0, 4).join(", ");
}

const undriven = (fault) => fault.key === "driver" && !fault.line;

function drawFaults() {
  faults.replaceChildren();
  for (const fault of told().slice(0, 12)) {
    const item = document.createElement("li");
    const button = document.createElement("button");
    const where = fault.line ? `${word("line")} ${fault.line}: ` : "";
    button.append(undriven(fault) ? word("state.undriven") : `${where}${fault.key ? `${fault.key}: ` : ""}${fault.message}`);
    if (fault.hint) {
      const hint = document.createElement("small");
      hint.textContent = fault.hint;
      button.append(hint);
    }
    button.disabled = !fault.line;
    button.addEventListener("click", () => goTo(fault.line));
    item.append(button);
    faults.append(item);
  }
}

// --- curves -----------------------------------------------------------------------------------------------------------

const curves = document.getElementById("curves");
const WIDTH = 420;
const HEIGHT = 168;
const MARGIN = { left: 46, right: 10, top: 12, bottom: 22 };
const DASHES = ["", "6 3", "2 3", "9 3 2 3"];
let cursors = [];

function chosenCurves() {
  const there = state.look?.curves ?? [];
  if (state.curves) return there.filter(({ symbol: name }) => state.curves.includes(name));
  const outputs = there.filter(({ role }) => role === "output");
  const plain = there.filter(({ role }) => role === "variable");
  return [...plain.slice(0, 3), ...outputs.slice(0, 2)];
}

function drawCurves() {
  if (curves.hidden) return;
  curves.replaceChildren();
  cursors = [];
  const there = state.look?.curves ?? [];
  if (!there.length) {
    curves.append(note(word("curves.none")));
    return;
  }
  const picked = chosenCurves();
  const chips = document.createElement("div");
  chips.className = "row chips";
  for (const { symbol: name, label } of there) {
    const chip = document.createElement("button");
    chip.innerHTML = symbol(name);
    chip.title = label;
    chip.setAttribute("aria-label", `${name}: ${label}`);
    chip.setAttribute("aria-pressed", String(picked.some((each) => each.symbol === name)));
    chip.addEventListener("click", () => {
      const now = chosenCurves().map((each) => each.symbol);
      state.curves = now.includes(name) ? now.filter((each) => each !== name) : [...now, name];
      keep();
      drawCurves();
    });
    chips.append(chip);
  }
  curves.append(chips);
  const units = [...new Set(picked.map(({ unit }) => unit))];
  for (const unit of units) curves.append(...chart(picked.filter((each) => each.unit === unit), unit));
  moveCursors();
}

function chart(drawn, unit) {
  const driver = state.look.frames.driver;
  const all = drawn.flatMap(({ values }) => values.filter((each) => each !== null));
  let [low, high] = [Math.min(...all), Math.max(...all)];
  if (high - low < 1e-9 * Math.max(1, Math.abs(high))) [low, high] = [low - 1, high + 1];
  const x = (n) => MARGIN.left + ((driver[n] - driver[0]) / (driver[driver.length - 1] - driver[0] || 1)) * (WIDTH - MARGIN.left - MARGIN.right);
  const y = (value) => HEIGHT - MARGIN.bottom - ((value - low) / (high - low)) * (HEIGHT - MARGIN.top - MARGIN.bottom);
  const lines = drawn.map(({ values }, index) => {
    let d = "";
    let pen = "M";
    values.forEach((value, n) => {
      if (value === null) pen = "M";
      else {
        d += `${pen}${x(n).toFixed(1)},${y(value).toFixed(1)}`;
        pen = "L";
      }
    });
    return `<path class="curve" d="${d}" stroke-dasharray="${DASHES[index % DASHES.length]}"/>`;
  });
  const ends = `<text x="${MARGIN.left}" y="${HEIGHT - 6}">${shown(driver[0], 4)}</text><text x="${WIDTH - MARGIN.right}" y="${HEIGHT - 6}" text-anchor="end">${shown(driver[driver.length - 1], 4)}${escaped(state.look.driver?.unit ?? "")}</text>`;
  const scale = `<text x="${MARGIN.left - 4}" y="${MARGIN.top + 4}" text-anchor="end">${shown(high, 3)}</text><text x="${MARGIN.left - 4}" y="${HEIGHT - MARGIN.bottom}" text-anchor="end">${shown(low, 3)}</text>`;
  const frame = `<path class="axis" d="M${MARGIN.left},${MARGIN.top}V${HEIGHT - MARGIN.bottom}H${WIDTH - MARGIN.right}"/>`;
  const head = document.createElement("p");
  head.className = "part";
  const holder = document.createElement("div");
  holder.innerHTML = `<svg class="chart" viewBox="0 0 ${WIDTH} ${HEIGHT}" preserveAspectRatio="none" role="img">${frame}${lines.join("")}<path class="here"/>${ends}${scale}</svg>`;
  const svg = holder.firstChild;
  svg.setAttribute("aria-label", drawn.map((each) => each.symbol).join(", "));
  svg.addEventListener("pointerdown", (event) => {
    const box = svg.getBoundingClientRect();
    const part = (((event.clientX - box.left) / box.width) * WIDTH - MARGIN.left) / (WIDTH - MARGIN.left - MARGIN.right);
    show(Math.round(Math.max(0, Math.min(1, part)) * (driver.length - 1)));
  });
  cursors.push(() => {
    svg.querySelector(".here").setAttribute("d", `M${x(state.frame)},${MARGIN.top}V${HEIGHT - MARGIN.bottom}`);
    head.innerHTML = drawn
      .map(({ symbol: name, values }, index) => `<svg width="26" height="8" aria-hidden="true"><path d="M0,4H26" class="curve" stroke="currentColor" stroke-width="1.7" stroke-dasharray="${DASHES[index % DASHES.length]}"/></svg> ${symbol(name)} = ${shown(values[state.frame], 5)}${unit === "°" ? "°" : ` ${escaped(unit)}`}`)
      .join(" &nbsp; ");
  });
  return [head, svg];
}

const moveCursors = () => cursors.forEach((each) => each());

// --- the workbook -----------------------------------------------------------------------------------------------------

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

// --- tabs -------------------------------------------------------------------------------------------------------------

const tabs = [...document.querySelectorAll('[role="tab"]')];
for (const [index, tab] of tabs.entries()) {
  tab.addEventListener("click", () => open(tab));
  tab.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (step) open(tabs[(index + step + tabs.length) % tabs.length], true);
  });
}

function open(chosen, focus = false) {
  for (const tab of tabs) {
    const here = tab === chosen;
    tab.setAttribute("aria-selected", String(here));
    tab.tabIndex = here ? 0 : -1;
    document.getElementById(tab.getAttribute("aria-controls")).hidden = !here;
  }
  if (focus) chosen.focus();
  drawCurves();
}

on("look language", () => {
  drawDimensions();
  drawFaults();
  drawCurves();
});
on("look frame language", drawState);
on("frame", () => {
  if (!curves.hidden) moveCursors();
});
on("language", drawWorkbook);
