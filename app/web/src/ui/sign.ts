// Signs of how near a limit is: a form, a colour and a word each, for eyes that miss one of them.
import { drawing, element } from './dom';

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
  const words = SIGN_WORDS[state];
  return drawing(FORMS[state], { class: `sign ${state}`, role: 'img', 'aria-label': words });
}

// Icon and words: one line below a knob, a heading of a card.
export function signed(state: SignState, words: string): HTMLElement {
  return element('span', { class: `signed ${state}` }, sign(state), element('span', words));
}
