// Light or dark: as the system is, until somebody chooses.
export class Theme {
  dark = matchMedia('(prefers-color-scheme: dark)').matches;

  constructor(private readonly changed: () => void) {
    document.documentElement.dataset.theme = this.dark ? 'dark' : 'light';
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
