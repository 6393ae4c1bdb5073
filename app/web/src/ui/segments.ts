// A choice among few, as buttons side by side: one stop of the tab key, arrows change it.
import { element } from './dom';

export class Segments {
  readonly root: HTMLElement;
  private readonly buttons: HTMLButtonElement[];
  chosen = '';

  constructor(
    label: string,
    private readonly names: string[],
    choose: (name: string) => void,
  ) {
    this.root = element('div', { class: 'segments', role: 'radiogroup', 'aria-label': label });
    this.buttons = names.map((name) => {
      const made = element('button', { type: 'button', role: 'radio' }, name);
      made.addEventListener('click', () => {
        this.show(name);
        choose(name);
      });
      return made;
    });
    this.root.append(...this.buttons);
    this.root.addEventListener('keydown', (event) => {
      const way = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
      if (!way) return;
      event.preventDefault();
      event.stopPropagation();
      const at = Math.max(0, this.names.indexOf(this.chosen));
      const next = this.buttons[(at + way + names.length) % names.length];
      next.focus();
      next.click();
    });
    this.show('');
  }

  show(name: string): void {
    this.chosen = name;
    const at = Math.max(0, this.names.indexOf(name));
    this.buttons.forEach((made, i) => {
      made.setAttribute('aria-checked', String(this.names[i] === name));
      made.tabIndex = i === at ? 0 : -1;
    });
  }
}
