// Signs of how near a limit is: a form, a colour and a word each, for eyes that miss one of them.
import { element } from '../ui/dom';

const FORMS = {
  ok: 'M2.5 8.5l3.5 3.5 7.5-8', // a tick
  near: 'M8 2L15 14H1zM8 6.5v3.5M8 12v.6', // a triangle
  beyond: 'M5 1.5h6L15 5.5v5l-4 4H5l-4-4v-5zM5.2 5.2l5.6 5.6M10.8 5.2l-5.6 5.6', // an octagon
};
export type SignState = keyof typeof FORMS;
export const SIGN_WORDS: Record<SignState, string> = {
  ok: 'holds',
  near: 'near the limit',
  beyond: 'beyond the limit',
};

export function sign(state: SignState): SVGSVGElement {
  const space = 'http://www.w3.org/2000/svg';
  const made = document.createElementNS(space, 'svg');
  made.setAttribute('viewBox', '0 0 16 16');
  made.setAttribute('class', `sign ${state}`);
  made.setAttribute('role', 'img');
  made.setAttribute('aria-label', SIGN_WORDS[state]);
  const path = document.createElementNS(space, 'path');
  path.setAttribute('d', FORMS[state]);
  made.append(path);
  return made;
}

// Icon and words: one line below a knob, a heading of a card.
export function signed(state: SignState, words: string): HTMLElement {
  return element('span', { class: `signed ${state}` }, sign(state), element('span', {}, words));
}
