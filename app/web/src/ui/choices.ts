// Choice of one option: tabs of the side panel, segmented buttons.
import { definition, element } from './dom';

// Tabs of the side panel: one tab stop; arrow keys move between the tabs.
export class Tabs {
  private readonly list = element('div', { role: 'tablist' });
  readonly root = element('aside', { 'aria-label': 'panel' }, this.list);
  private readonly tabs: HTMLButtonElement[] = [];
  private readonly panels: HTMLElement[] = [];
  current = 0;

  constructor() {
    this.list.addEventListener('keydown', (event) => {
      const last = this.tabs.length - 1;
      const { current } = this;
      const to = { ArrowRight: current + 1, ArrowLeft: current - 1, Home: 0, End: last }[event.key];
      if (to === undefined) return;
      event.preventDefault();
      this.show(to < 0 ? last : to > last ? 0 : to);
      this.tabs[this.current].focus();
    });
  }

  add(title: string, ...content: Node[]): void {
    const at = this.tabs.length;
    const ids = { id: `tab-${at}`, 'aria-controls': `panel-${at}` };
    const click = () => this.show(at);
    const tab = element('button', { type: 'button', role: 'tab', title: definition(title), ...ids, click }, title);
    const panel = element(
      'div',
      { role: 'tabpanel', id: `panel-${at}`, tabindex: '0', 'aria-labelledby': tab.id },
      ...content,
    );
    this.tabs.push(tab);
    this.panels.push(panel);
    this.list.append(tab);
    this.root.append(panel);
    this.show(0);
  }

  show(chosen: number): void {
    this.current = chosen;
    this.tabs.forEach((tab, i) => {
      tab.setAttribute('aria-selected', String(i === chosen));
      tab.tabIndex = i === chosen ? 0 : -1;
    });
    this.panels.forEach((panel, i) => (panel.hidden = i !== chosen));
  }
}

let groups = 0;

// Radio buttons side by side: one tab stop; arrow keys change the choice.
export class Segments {
  readonly root: HTMLElement;
  private readonly choices: HTMLInputElement[];

  constructor(label: string, names: string[], chosen: string, choose: (name: string) => void) {
    const name = `segments-${groups++}`;
    this.choices = names.map((value) => element('input', { type: 'radio', name, value, 'aria-label': value }));
    this.root = element('div.segments', { role: 'radiogroup', 'aria-label': label });
    this.root.append(...this.choices);
    this.show(chosen);
    this.root.addEventListener('change', ({ target }) => choose((target as HTMLInputElement).value));
  }

  show(name: string): void {
    for (const choice of this.choices) choice.checked = choice.value === name;
  }
}
