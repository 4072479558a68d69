// The panels beside the drawing, one of them shown at a time.

import { drawCurves } from "./curves.js";
import "./dimensions.js";
import "./faults.js";
import "./inserting.js";
import "./workbook.js";

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
