// Theme (the system's until the user chooses), and choices stored by the browser.

export class Theme {
  private readonly system = matchMedia('(prefers-color-scheme: dark)');
  private isChosen = false; // by the user
  dark = this.system.matches;

  constructor(private readonly changed: () => void) {
    document.documentElement.dataset.theme = this.dark ? 'dark' : 'light';
    this.system.addEventListener('change', ({ matches }) => this.isChosen || this.set(matches));
    // Print in the light theme.
    let chosen = this.dark;
    addEventListener('beforeprint', () => {
      chosen = this.dark;
      if (chosen) this.set(false);
    });
    addEventListener('afterprint', () => {
      if (chosen) this.set(true);
    });
  }

  toggle(): void {
    this.isChosen = true;
    this.set(!this.dark);
  }

  set(dark: boolean): void {
    this.dark = dark;
    document.documentElement.dataset.theme = dark ? 'dark' : 'light';
    this.changed();
  }
}

export function token(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

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
    // Storage may be disabled.
  }
}
