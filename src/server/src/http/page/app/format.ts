// Numbers and times in words.

/** Formats a number with four significant digits. */
export function short(number: number | null | undefined): string {
  if (number === null || number === undefined || !Number.isFinite(number)) return "–";
  const size = Math.abs(number);
  if (size !== 0 && (size < 1e-3 || 1e7 <= size)) return number.toExponential(2);
  return Number(number.toPrecision(4)).toLocaleString("en-US", { maximumFractionDigits: 6 });
}

export function whole(number: number): string {
  return number.toLocaleString("en-US");
}

export function percent(share: number): string {
  return `${(100 * share).toFixed(1)} %`;
}

export function bytes(count: number): string {
  for (const [unit, size] of [["MB", 1e6], ["kB", 1e3]] as const) {
    if (size <= count) return `${(count / size).toFixed(count < 10 * size ? 1 : 0)} ${unit}`;
  }
  return `${count} B`;
}

export function duration(milliseconds: number): string {
  const seconds = milliseconds / 1000;
  if (seconds < 60) return `${seconds.toFixed(1)} s`;
  return `${Math.floor(seconds / 60)} min ${Math.floor(seconds % 60)} s`;
}

/** Formats the time since a moment. */
export function ago(time: string): string {
  const seconds = Math.max(0, (Date.now() - Date.parse(time)) / 1000);
  if (seconds < 60) return "just now";
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min ago`;
  if (seconds < 86400) return `${Math.floor(seconds / 3600)} h ago`;
  return new Date(time).toLocaleDateString();
}

/** Formats a count with its noun, in the plural for any count but one. */
export function counted(count: number, one: string, several = `${one}s`): string {
  return `${whole(count)} ${count === 1 ? one : several}`;
}

/** Begins a message with a capital and ends it with a stop. */
export function sentence(message: string): string {
  return message.charAt(0).toUpperCase() + message.slice(1) + (/[.!?]$/.test(message) ? "" : ".");
}

/** Formats a word of the API for people. */
export function plain(word: string): string {
  const text = word.replaceAll("_", " ").replaceAll("-", " ").replace(/\buv(s?)\b/g, "UV$1");
  return text.charAt(0).toUpperCase() + text.slice(1);
}
