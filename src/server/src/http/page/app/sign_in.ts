// The API key, if the service requires one: exchanged once for a cookie that scripts cannot read.

import { button, byId, element } from "./dom";

/** The caller as the service sees it. */
export interface Caller { owner: string | null; signed_in: boolean }

let asking: Promise<void> | null = null;

/** Asks for a key until the service accepts one. All calls that need a key wait for the same dialog. */
export function signIn(): Promise<void> {
  asking ??= ask().finally(() => (asking = null));
  return asking;
}

function ask(): Promise<void> {
  const dialog = byId<HTMLDialogElement>("sign-in");
  const field = element("input", { type: "password", id: "sign-in-key", autocomplete: "off", required: true, spellcheck: false });
  const error = element("p", { className: "wrong", aria: { role: "alert" } });
  return new Promise((resolve, reject) => {
    const form = element("form", {},
      element("h2", { id: "sign-in-title", textContent: "Sign in" }),
      element("p", {}, "This service asks for a key, which ", element("code", { textContent: "unwrapd keys create" }), " makes."),
      element("div", { className: "row" }, element("label", { htmlFor: field.id, textContent: "API key" }), field),
      error,
      element("button", { type: "submit", className: "primary", textContent: "Sign in" }));
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      void exchange(field.value).then((refusal) => {
        error.textContent = refusal ?? "";
        field.value = "";
        if (refusal !== null) return field.focus();
        resolve();
        dialog.close();
      });
    });
    dialog.addEventListener("close", () => reject(new Error("Signing in was cancelled. Reload the page to sign in.")), { once: true });
    dialog.replaceChildren(form);
    dialog.showModal();
    field.focus();
  });
}

/** Exchanges a key for a cookie. Returns the reason of a rejection, or null. */
async function exchange(key: string): Promise<string | null> {
  try {
    const answer = await fetch("v1/sign-in", { method: "POST", headers: { authorization: `Bearer ${key.trim()}` } });
    if (answer.ok) return null;
    return answer.status === 401 ? "The service does not know this key, or it has ended." : `The service answered with status ${answer.status}.`;
  } catch {
    return "The service does not answer, or this is no key.";
  }
}

/** Shows the signed-in owner and a button to sign out. */
export function showCaller(caller: Caller, leave: () => void): void {
  const name = caller.owner ?? "";
  byId("caller").replaceChildren(...(caller.signed_in ? [button("Sign out", leave, { className: "bare", title: `Signed in as ${name}` })] : []));
}

/** Returns whether calls of other clients need a key. */
export function needsKey(): boolean {
  return byId("caller").childElementCount > 0;
}
