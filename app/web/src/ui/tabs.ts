// Pages of the side panel.
import { element } from './dom';

export class Tabs {
  readonly root: HTMLElement;
  private readonly list = element('div', { role: 'tablist' });
  private readonly tabs: HTMLButtonElement[] = [];
  private readonly panels: HTMLElement[] = [];
  current = 0;

  constructor() {
    this.root = element('aside', {}, this.list);
  }

  add(title: string, ...content: Node[]): void {
    const at = this.tabs.length;
    const panel = element('div', { role: 'tabpanel', id: `panel-${at}` }, ...content);
    const tab = element(
      'button',
      { type: 'button', role: 'tab', 'aria-controls': panel.id },
      title,
    );
    tab.addEventListener('click', () => this.show(at));
    this.tabs.push(tab);
    this.panels.push(panel);
    this.list.append(tab);
    this.root.append(panel);
    this.show(0);
  }

  show(chosen: number): void {
    this.current = chosen;
    this.tabs.forEach((tab, i) => tab.setAttribute('aria-selected', String(i === chosen)));
    this.panels.forEach((panel, i) => (panel.hidden = i !== chosen));
  }
}
