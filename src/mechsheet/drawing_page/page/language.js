// The words of the page in every language; `words.js` is the program's own list.

import { WORDS } from "./words.js";
import { icon } from "./icons.js";
import { state, on } from "./state.js";

export const LANGUAGES = Object.keys(WORDS);

/** The language that a click on the button leads to. */
export const next = () => LANGUAGES[(LANGUAGES.indexOf(state.language) + 1) % LANGUAGES.length];

/** What a language is called by those who speak it. */
export const called = (language) => WORDS[language]["language.own"];

/** A text in the page's language, its {parts} filled in. */
export function word(key, parts = {}) {
  const text = WORDS[state.language]?.[key] ?? WORDS.en[key] ?? key;
  return text.replace(/\{(\w+)\}/g, (whole, name) => (name in parts ? parts[name] : whole));
}

/** Give every element of the page its words. */
export function label() {
  document.documentElement.lang = state.language;
  for (const element of document.querySelectorAll("[data-word]")) element.textContent = word(element.dataset.word);
  for (const element of document.querySelectorAll("[data-label]")) element.setAttribute("aria-label", word(element.dataset.label));
  for (const element of document.querySelectorAll("[data-hint]")) {
    element.title = word(element.dataset.hint);
    element.setAttribute("aria-label", word(element.dataset.hint));
  }
  document.getElementById("canvas").setAttribute("aria-label", word("drawing"));
  document.getElementById("position").setAttribute("aria-label", word("position"));
  document.getElementById("language").textContent = next().toUpperCase();
}

for (const element of document.querySelectorAll("[data-icon]")) element.append(icon(element.dataset.icon));
on("language", label);

/** A remark in grey, as a paragraph. */
export function note(text) {
  const made = document.createElement("p");
  made.className = "note";
  made.textContent = text;
  return made;
}
