// What can be taken out of the lab: the run, a page of it, the scene.
import { element } from '../ui/dom';

const FILES: [string, string, string][] = [
  ['/save', 'Recording', 'the run as it is remembered (.twinrec): replays bit by bit'],
  ['/share', 'Page to share', 'the same in one file that any browser opens'],
  ['/scene', 'Scene', 'as it runs now, all that was turned included (.toml)'],
];

export class SaveMenu {
  readonly root = element('details.menu');

  constructor() {
    const list = element('div.sheet');
    for (const [address, name, what] of FILES) {
      const words = [element('b', name), element('span', what)];
      const link = element('a', { href: address, download: '' }, ...words);
      link.addEventListener('click', () => (this.root.open = false));
      list.append(link);
    }
    this.root.append(element('summary', { title: 'save, share' }, 'Save'), list);
    closesByItself(this.root);
  }
}

// A press elsewhere or Escape closes it.
export function closesByItself(menu: HTMLDetailsElement): void {
  document.addEventListener('pointerdown', (event) => {
    if (menu.open && !menu.contains(event.target as Node)) menu.open = false;
  });
  menu.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || !menu.open) return;
    menu.open = false;
    menu.querySelector('summary')!.focus();
    event.stopPropagation();
  });
}
