// Scenes of the gallery, and files of the user: a URDF, a scene or a recording, which the lab imports.
import './gallery.css';
import { bullets, button, changeDetector, element } from '../ui/dom';
import type { StateMessage } from '../source/link';
import type { LabPage, Panel } from './panel';

const MESHES = /\.(stl|obj|dae|ply|gltf|glb|bin|png|jpe?g|mtl)$/i; // sent before the robot
const ROBOTS = '.urdf,.xml,.xacro,.toml,.twinrec,.stl,.obj,.dae,.ply,.gltf,.glb,.mtl,.png,.jpg,.jpeg';

export class Gallery implements Panel {
  readonly root = element('dialog.card-dialog.gallery', {
    'aria-label': 'scenes',
    keydown: (event: KeyboardEvent) => this.press(event),
    click: (event: Event) => event.target === this.root && this.root.close(),
  });
  private readonly cards = element('div.cards');
  private readonly zone = element('div.zone');
  private readonly message = element('div.message', { role: 'status' });
  private readonly input = element('input', { type: 'file', multiple: '', accept: ROBOTS });
  private readonly isNew = changeDetector();
  private opening = Promise.resolve();

  constructor(private readonly page: LabPage) {
    this.input.hidden = true;
    this.input.addEventListener('change', () => {
      void this.open([...(this.input.files ?? [])]);
      this.input.value = '';
    });
    this.zone.append(
      'Drop a robot (URDF with meshes), a scene or a recording anywhere on this page, or',
      button('open files …', 'from this computer', () => this.input.click()),
      this.input,
    );
    const close = button('×', 'close (Escape)', () => this.root.close(), 'close');
    this.root.append(element('header', element('h2', 'Scenes'), close), this.message, this.cards, this.zone);
    this.acceptDrops();
  }

  onState({ gallery }: StateMessage): void {
    if (this.isNew(gallery)) this.cards.replaceChildren(...gallery.map((entry) => this.card(entry)));
  }

  private card({ name, title, look }: StateMessage['gallery'][number]): HTMLElement {
    const src = `/gallery/${encodeURIComponent(name)}.png`;
    const image = element('img', { src, alt: '', loading: 'lazy', error: () => image.remove() });
    const click = () => this.page.send({ do: 'scene', name }) && this.root.close();
    const attributes = { type: 'button', 'data-scene': name, click };
    return element('button.card', attributes, image, element('b', title), bullets(look));
  }

  // Arrow keys move between the cards.
  private press(event: KeyboardEvent): void {
    event.stopPropagation();
    const cards = [...this.cards.children] as HTMLElement[];
    const at = cards.indexOf(document.activeElement as HTMLElement);
    if (at < 0) return;
    const top = cards[0].offsetTop;
    const across = cards.filter((card) => card.offsetTop === top).length;
    const way = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: across, ArrowUp: -across }[event.key];
    const next = way && cards[at + way];
    if (!next) return;
    event.preventDefault();
    next.focus();
  }

  private acceptDrops(): void {
    const target = element('div.drop-target', { 'aria-hidden': 'true', hidden: '' }, 'Drop to open');
    document.body.append(target);
    const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
    for (const kind of ['dragover', 'drop'] as const)
      document.addEventListener(kind, (event) => {
        if (!hasFiles(event)) return;
        event.preventDefault();
        target.hidden = kind === 'drop';
        if (kind === 'drop') void this.open([...event.dataTransfer!.files]);
      });
    document.addEventListener('dragleave', (event) => {
      if (!event.relatedTarget) target.hidden = true;
    });
  }

  // One set of files after the other: the message is about the last.
  open(files: File[]): Promise<void> {
    this.opening = this.opening.then(() => this.openSet(files));
    return this.opening;
  }

  // Meshes first, one by one, then the file that refers to them.
  private async openSet(files: File[]): Promise<void> {
    if (files.length === 0) return;
    const rank = ({ name }: File) => (MESHES.test(name) ? 0 : 1);
    const sorted = [...files].sort((a, b) => rank(a) - rank(b));
    let opened = false;
    for (const file of sorted) {
      this.show('note', `Opening ${file.name} …`);
      const { state, words } = await post(file, this.page.state?.secret ?? '');
      if (state === 'failed') {
        const errors = words.split('\n').filter((line) => line.trim());
        return this.stop('error', `${file.name} was not opened`, errors);
      }
      opened = state === 'opened';
    }
    const { name } = sorted[sorted.length - 1];
    if (!opened) return this.stop('note', `${name} is stored: now open the robot that refers to it`);
    this.message.replaceChildren();
    this.root.close();
    this.page.showMessage(`${name} is open`);
  }

  private stop(level: string, text: string, errors: string[] = []): void {
    this.show(level, text, errors);
    if (!this.root.open) this.root.showModal();
  }

  private show(level: string, text: string, errors: string[] = []): void {
    this.message.className = `message ${level}`;
    this.message.replaceChildren(element('b', text), ...(errors.length > 0 ? [bullets(errors)] : []));
  }
}

const KEPT = 202; // HTTP: Accepted

// The lab's answer to an upload, with all errors.
type Answer = { state: 'opened' | 'kept' | 'failed'; words: string };
export async function post(file: File, secret: string): Promise<Answer> {
  try {
    const query = new URLSearchParams({ name: file.name, secret });
    const answer = await fetch(`/open?${query}`, { method: 'POST', body: file });
    const words = await answer.text();
    const state = answer.status === KEPT ? 'kept' : answer.ok ? 'opened' : 'failed';
    return { state, words: words || `HTTP status ${answer.status}` };
  } catch {
    return { state: 'failed', words: 'the lab does not answer' };
  }
}
