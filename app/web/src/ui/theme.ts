// Light or dark: as the system is, until somebody chooses.
export class Theme {
  dark = matchMedia('(prefers-color-scheme: dark)').matches;

  constructor(private readonly changed: () => void) {
    document.documentElement.dataset.theme = this.dark ? 'dark' : 'light';
    // Paper is white.
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
