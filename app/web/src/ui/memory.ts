// What the page keeps of a person's choices, where the browser lets it.
export function remembered<T>(name: string, otherwise: T): T {
  try {
    const text = localStorage.getItem(`twinarm.${name}`);
    return text === null ? otherwise : (JSON.parse(text) as T);
  } catch {
    return otherwise;
  }
}

export function remember(name: string, value: unknown): void {
  try {
    localStorage.setItem(`twinarm.${name}`, JSON.stringify(value));
  } catch {
    // A private window keeps nothing.
  }
}
