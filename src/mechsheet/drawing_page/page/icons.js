// The icons of the buttons: shapes in a square of 24, drawn in the colour of the text.

const SHAPES = {
  shape: '<path d="M6 3l12 9-5.5 1 3.5 6-2.5 1.4-3.4-6L6 18z"/>',
  turn: '<path d="M5 13a7.5 7.5 0 1 1 3 5"/><path d="M2.5 10.5 5 13.5l3-2.5"/><circle cx="12.3" cy="12" r="1.6"/>',
  ground: '<circle cx="12" cy="6" r="2.4"/><path d="M10.5 8 6 16h12l-4.5-8"/><path d="M4 16h16M6 16l-2 4m6-4-2 4m6-4-2 4m6-4-2 4"/>',
  link: '<circle cx="5.5" cy="17.5" r="2.5"/><circle cx="18.5" cy="6.5" r="2.5"/><path d="M7.5 16 16.5 8"/>',
  plate: '<path d="M5 19 20 16 11 5z"/><circle cx="5" cy="19" r="1.8"/><circle cx="20" cy="16" r="1.8"/><circle cx="11" cy="5" r="1.8"/>',
  slider: '<rect x="6" y="8.5" width="12" height="7" rx="1"/><path d="M2 18.5h20"/><circle cx="12" cy="12" r="1.4"/>',
  slot: '<path d="M3 17 17 5m4 3L7 20"/><circle cx="12.3" cy="12.3" r="2.6"/>',
  driver: '<path d="M12 20V10"/><circle cx="12" cy="20" r="1.8"/><path d="M5 12a7.3 7.3 0 0 1 13-2"/><path d="M18.5 5.5v5h-5"/>',
  gear: '<circle cx="8.5" cy="15" r="5"/><circle cx="17.500" cy="7.500" r="3.700"/><circle cx="8.500" cy="15" r="1"/><circle cx="17.500" cy="7.500" r="1"/>',
  spring: '<path d="M3 19 6 16l-1-3.5 5 .5-1-4.5 5 .5-1-4.5 4 .5L21 4"/><circle cx="3" cy="19" r="1.4"/><circle cx="21" cy="4" r="1.4"/>',
  damper: '<path d="M3 20 9 14M14 9l7-6"/><path d="m6.5 11.5 6 6 5.5-5.5m-5.5-5.5-6 5"/><path d="m10.5 5.5 7 7"/>',
  force: '<path d="M4 20 18 6"/><path d="M18 6l-7 1.5M18 6l-1.500 7"/><circle cx="4" cy="20" r="1.6"/>',
  torque: '<path d="M19 13a7.500 7.500 0 1 1-3-6.500"/><path d="M16.500 2.500v4.500h-4.500"/>',
  mass: '<circle cx="12" cy="12" r="8"/><path d="M12 4v16M4 12h16"/><path d="M12 4a8 8 0 0 1 8 8h-8zM12 20a8 8 0 0 1-8-8h8z" fill="currentColor"/>',
  delete: '<path d="M5 7h14M10 7V4.5h4V7M7 7l1 13h8l1-13"/>',
  undo: '<path d="M8 5 4 9l4 4"/><path d="M4 9h9.5a5.5 5.5 0 0 1 0 11H8"/>',
  redo: '<path d="m16 5 4 4-4 4"/><path d="M20 9h-9.5a5.5 5.5 0 0 0 0 11H16"/>',
  theme: '<circle cx="12" cy="12" r="8"/><path d="M12 4a8 8 0 0 1 0 16z" fill="currentColor"/>',
  fit: '<path d="M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5"/>',
  grid: '<path d="M4 8h16M4 16h16M8 4v16M16 4v16"/>',
  paths: '<path d="M4 15c2-9 7-12 10-9s-2 9 1 11 5-3 5-6"/><circle cx="4" cy="15.5" r="1.5"/>',
  picture: '<rect x="3.5" y="5" width="17" height="14" rx="1.5"/><circle cx="9" cy="10" r="1.5"/><path d="m5 18 5.5-5 3 2.5 3-3.5 3.5 4"/>',
  play: '<path d="M7 4.5 19 12 7 19.5z" fill="currentColor"/>',
  pause: '<path d="M8 5v14M16 5v14" stroke-width="3"/>',
};

/** An icon as an element; the words beside it, or the button's label, say what it means. */
export function icon(name) {
  const holder = document.createElement("span");
  holder.setAttribute("aria-hidden", "true");
  holder.innerHTML = `<svg class="icon" viewBox="0 0 24 24" focusable="false">${SHAPES[name]}</svg>`;
  return holder;
}
