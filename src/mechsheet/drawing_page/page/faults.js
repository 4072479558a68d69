// Below the drawing: degrees of freedom, where the links can be joined, and what is wrong with the description.

import { shown } from "./geometry.js";
import { word } from "./language.js";
import { on, state } from "./state.js";
import { goTo, told } from "./textpane.js";

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

on("look language", drawFaults);
on("look frame language", drawState);
