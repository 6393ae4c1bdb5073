// A choice among few, side by side: one stop of the tab key, arrows change it.
import { element } from './dom';

let groups = 0;

export class Segments {
  readonly root: HTMLElement;
  private readonly choices: HTMLInputElement[];

  constructor(label: string, names: string[], choose: (name: string) => void) {
    const name = `segments-${groups++}`;
    this.choices = names.map((value) =>
      element('input', { type: 'radio', name, value, 'aria-label': value }),
    );
    this.root = element('div.segments', { role: 'radiogroup', 'aria-label': label });
    this.root.append(...this.choices);
    this.root.addEventListener('change', ({ target }) => choose((target as HTMLInputElement).value));
  }

  show(name: string): void {
    for (const choice of this.choices) choice.checked = choice.value === name;
  }
}
