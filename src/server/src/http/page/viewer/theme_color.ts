// Colors of the style sheet in the current theme.

/** Returns a color by the name of its variable. */
export function color(name: string): string {
  const probe = document.documentElement;
  const before = probe.style.outlineColor;
  probe.style.outlineColor = `var(${name})`;
  const { outlineColor } = getComputedStyle(probe);
  probe.style.outlineColor = before;
  return outlineColor;
}
