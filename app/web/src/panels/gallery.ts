// Scenes to choose from, each with what to look for; and files of one's own: a URDF, a scene, a
// recording. The lab imports them; what it says of faults is shown as it says it.
import './gallery.css';
import { bullets, button, changeDetector, element } from '../ui/dom';
import type { StateMessage } from '../source/link';
import type { LabPage, Panel } from './panel';

const MESHES = /\.(stl|obj|dae|ply|gltf|glb|bin|png|jpe?g|mtl)$/i; // go first: a robot's file names them
const ROBOTS = '.urdf,.xml,.xacro,.toml,.twinrec,.stl,.obj,.dae,.ply,.gltf,.glb,.mtl,.png,.jpg,.jpeg';

export class Gallery implements Panel {
  readonly root = element('dialog.card-dialog.gallery', { 'aria-label': 'scenes' });
  private readonly cards = element('div.cards');
  private readonly zone = element('div.zone');
  private readonly said = element('div.said', { role: 'status' });
  private readonly input = element('input', { type: 'file', multiple: '', accept: ROBOTS });
  private readonly isNew = changeDetector();

  constructor(private readonly page: LabPage) {
    this.input.hidden = true;
    this.input.addEventListener('change', () => {
      void this.open([...(this.input.files ?? [])]);
      this.input.value = '';
    });
    this.zone.append(
      element('p', 'Drop a robot (URDF, with its meshes), a scene or a recording anywhere on this page, or'),
      button('open files …', 'from this computer', () => this.input.click()),
      this.input,
    );
    const close = button('×', 'close (Escape)', () => this.root.close(), 'close');
    this.root.append(element('header', element('h2', 'Scenes'), close), this.said, this.cards, this.zone);
    this.root.addEventListener('click', (event) => {
      if (event.target === this.root) this.root.close();
    });
    this.root.addEventListener('keydown', (event) => this.press(event));
    this.takeDrops();
  }

  onState({ gallery }: StateMessage): void {
    if (this.isNew(gallery)) this.cards.replaceChildren(...gallery.map((entry) => this.card(entry)));
  }

  private card({ name, title, look }: StateMessage['gallery'][number]): HTMLElement {
    const src = `/gallery/${encodeURIComponent(name)}.png`;
    const image = element('img', { src, alt: '', loading: 'lazy' });
    image.addEventListener('error', () => image.remove());
    const words = [element('b', title), bullets(look)];
    const card = element('button.card', { type: 'button', 'data-scene': name }, image, ...words);
    card.addEventListener('click', () => {
      if (this.page.send({ do: 'scene', name })) this.root.close();
    });
    return card;
  }

  // Arrows go from card to card as they lie.
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

  private takeDrops(): void {
    const curtain = element('div.curtain', { 'aria-hidden': 'true', hidden: '' }, 'Let go to open it here');
    document.body.append(curtain);
    const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
    for (const kind of ['dragover', 'drop'] as const)
      document.addEventListener(kind, (event) => {
        if (!hasFiles(event)) return;
        event.preventDefault();
        curtain.hidden = kind === 'drop';
        if (kind === 'drop') void this.open([...event.dataTransfer!.files]);
      });
    document.addEventListener('dragleave', (event) => {
      if (!event.relatedTarget) curtain.hidden = true;
    });
  }

  // Meshes first, one by one, then what names them.
  async open(files: File[]): Promise<void> {
    if (files.length === 0) return;
    const rank = ({ name }: File) => (MESHES.test(name) ? 0 : 1);
    const sorted = [...files].sort((a, b) => rank(a) - rank(b));
    let opened = false;
    for (const file of sorted) {
      this.tell('note', `Opening ${file.name} …`);
      const { state, words } = await post(file, this.page.state?.secret ?? '');
      if (state === 'failed') {
        const faults = words.split('\n').filter((line) => line.trim());
        return this.stop('error', `${file.name} was not opened`, faults);
      }
      opened = state === 'opened';
    }
    const { name } = sorted[sorted.length - 1];
    if (!opened) return this.stop('note', `${name} is kept: now open the robot that names it`);
    this.said.replaceChildren();
    this.root.close();
    this.page.say(`${name} is open`);
  }

  private stop(level: string, words: string, faults: string[] = []): void {
    this.tell(level, words, faults);
    if (!this.root.open) this.root.showModal();
  }

  private tell(level: string, words: string, faults: string[] = []): void {
    this.said.className = `said ${level}`;
    this.said.replaceChildren(element('b', words), ...(faults.length > 0 ? [bullets(faults)] : []));
  }
}

const KEPT = 202; // HTTP: Accepted

// What the lab says of it: that it is open or kept, or all its faults.
type Answer = { state: 'opened' | 'kept' | 'failed'; words: string };
export async function post(file: File, secret: string): Promise<Answer> {
  try {
    const query = new URLSearchParams({ name: file.name, secret });
    const answer = await fetch(`/open?${query}`, { method: 'POST', body: file });
    const words = await answer.text();
    const state = answer.status === KEPT ? 'kept' : answer.ok ? 'opened' : 'failed';
    return { state, words: words || `the lab answers ${answer.status}` };
  } catch {
    return { state: 'failed', words: 'the lab does not answer' };
  }
}
