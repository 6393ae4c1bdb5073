// Files dropped onto the page, or chosen: scenes, robots, recordings, and the meshes that they name.
import { element } from '../ui/dom';

const MESHES = /\.(stl|obj|dae|ply|glb|gltf|mtl|bin|png|jpe?g)$/i;

export class OpenFiles {
  readonly cover = element(
    'div',
    { class: 'drop', hidden: '' },
    element('p', {}, 'Drop a scene (.toml), a robot (.urdf, with its meshes) or a recording (.twinrec)'),
  );
  readonly faults = element('dialog', { class: 'faults', 'aria-label': 'why it was not opened' });
  private depth = 0; // dragenter comes for each element on the way

  constructor(private readonly on: { claim(): boolean; say(words: string): void }) {
    const files = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
    const show = (event: DragEvent, by: number) => {
      if (!files(event)) return;
      event.preventDefault();
      this.depth = Math.max(0, this.depth + by);
      this.cover.hidden = this.depth === 0;
    };
    addEventListener('dragenter', (event) => show(event, 1));
    addEventListener('dragleave', (event) => show(event, -1));
    addEventListener('dragover', (event) => {
      if (files(event)) event.preventDefault();
    });
    addEventListener('drop', (event) => {
      if (!files(event)) return;
      event.preventDefault();
      this.depth = 0;
      this.cover.hidden = true;
      void this.open([...event.dataTransfer!.files]);
    });
  }

  // Meshes first, then what names them.
  async open(files: File[]): Promise<void> {
    if (files.length === 0 || !this.on.claim()) return;
    const isMesh = (file: File) => MESHES.test(file.name);
    const inOrder = [...files.filter(isMesh), ...files.filter((file) => !isMesh(file))];
    for (const file of inOrder) {
      this.on.say(`Opening ${file.name} ..`);
      const faults = await post(file);
      if (faults !== null) return this.tell(file.name, faults);
    }
    this.on.say(`${inOrder[inOrder.length - 1].name} is open.`);
  }

  choose(): void {
    const input = element('input', { type: 'file', multiple: '' });
    input.addEventListener('change', () => void this.open([...(input.files ?? [])]));
    input.click();
  }

  private tell(name: string, faults: string): void {
    const close = element('button', { type: 'button' }, 'close');
    close.addEventListener('click', () => this.faults.close());
    this.faults.replaceChildren(
      element('h2', {}, `${name} was not opened`),
      element('pre', {}, faults),
      element('p', {}, 'The run that was here goes on.'),
      close,
    );
    this.faults.showModal();
  }
}

// Null: it is open.
async function post(file: File): Promise<string | null> {
  try {
    const address = `/open?name=${encodeURIComponent(file.name)}`;
    const answer = await fetch(address, { method: 'POST', body: file });
    return answer.ok ? null : (await answer.text()) || `the lab answered ${answer.status}`;
  } catch {
    return 'the lab did not answer: is it still running?';
  }
}
