// Theme (the system's until the user chooses), choices stored by the browser, buttons for a projector.
import { button, icon } from './dom';

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
    addEventListener('afterprint', () => chosen && this.set(true));
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

// For a projector: large type, and the whole screen.
export function presenterButtons(): HTMLButtonElement[] {
  const show = (isLarge: boolean) => {
    document.body.classList.toggle('large', isLarge);
    type.setAttribute('aria-pressed', String(isLarge));
    remember('large', isLarge);
  };
  const toggle = () => show(!document.body.classList.contains('large'));
  const type = button('A+', 'A+: large type', toggle, 'presenter');
  show(remembered('large', false));
  if (!document.fullscreenEnabled) return [type];
  const fill = () =>
    void (document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen());
  return [type, button(icon('full'), 'full screen', fill, 'presenter')];
}
