// Dark and light theme: that of the system until a person chooses.

import { byId } from "./dom";
import { keep, kept } from "./memory";

/** Applies the theme chosen earlier, and follows new choices. */
export function startTheme(changed: () => void): void {
  const { name } = kept("theme");
  if (name) document.documentElement.dataset.theme = name;
  const say = () => (byId("theme").textContent = isDark() ? "Light" : "Dark");
  byId("theme").addEventListener("click", () => {
    const name = isDark() ? "light" : "dark";
    document.documentElement.dataset.theme = name;
    keep("theme", { name });
    say();
    changed();
  });
  say();
}

function isDark(): boolean {
  const { theme } = document.documentElement.dataset;
  return theme ? theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
}
