// Questions to the program: JSON each way, and of many in a row only the last one counts.

import { state } from "./state.js";

/** The answer to a question. Throws an Error with what is wrong, in words of the page's language. */
export async function ask(name, question = {}) {
  const found = await (await asked(name, question)).json();
  if (found.errors) throw new Error(found.errors.join("\n"));
  return found;
}

/** The file that a question asks for. */
export async function askFile(name, question) {
  const answer = await asked(name, question);
  const said = answer.headers.get("Content-Type").startsWith("application/json");
  if (said) throw new Error((await answer.json()).errors.join("\n"));
  return answer.blob();
}

async function asked(name, question) {
  const answer = await fetch(`ask/${name}`, {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify({ ...question, spoken: state.language }),
    cache: "no-store",
  });
  if (answer.ok) return answer;
  let errors = [answer.statusText];
  try {
    errors = (await answer.json()).errors ?? errors;
  } catch {
    // no JSON: the status says it
  }
  throw new Error(errors.join("\n"));
}

/** Runs one task after the other; while one runs, only the last of those that come is kept. */
export class Latest {
  constructor(task) {
    this.task = task;
    this.running = false;
    this.waiting = null;
    this.idle = Promise.resolve();
  }

  run(...values) {
    this.waiting = values;
    if (!this.running) this.idle = this.work();
    return this.idle;
  }

  async work() {
    this.running = true;
    try {
      while (this.waiting) {
        const values = this.waiting;
        this.waiting = null;
        await this.task(...values);
      }
    } finally {
      this.running = false;
    }
  }
}
