// Dark and light theme: that of the system until a person chooses.

import { byId } from "./dom";

const KEY = "unwrapd-theme";

/** Applies the theme chosen earlier, and follows new choices. */
export function startTheme(changed: () => void): void {
  const stored = localStorage.getItem(KEY);
  if (stored) document.documentElement.dataset.theme = stored;
  const say = () => (byId("theme").textContent = isDark() ? "Light" : "Dark");
  byId("theme").addEventListener("click", () => {
    const chosen = isDark() ? "light" : "dark";
    document.documentElement.dataset.theme = chosen;
    localStorage.setItem(KEY, chosen);
    say();
    changed();
  });
  say();
}

function isDark(): boolean {
  const { theme } = document.documentElement.dataset;
  return theme ? theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
}
