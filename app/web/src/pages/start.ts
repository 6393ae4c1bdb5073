// How a page begins: what it carries is read and shown, or the page says why it cannot be.
import { embedded } from '../source/embedded';
import type { MeshData } from '../protocol/run';
import { element } from '../ui/dom';

// `show` gives what tests and the curious find as window.twinarm.
export function start<T extends { meshes: MeshData[]; textures: ImageBitmap[] }>(
  show: (data: T) => object,
): void {
  const begin = async (): Promise<void> => {
    Object.assign(window, { twinarm: show(await embedded<T>()) });
    document.documentElement.dataset.ready = 'true';
  };
  begin().catch((error: unknown) => {
    const words = error instanceof Error ? error.message : String(error);
    const text = `This page cannot be shown: ${words}`;
    document.body.replaceChildren(element('p.failed', { role: 'alert' }, text));
    console.error(error);
  });
}
