// Makes what stands like what was made anew, in place: focus, pointer, scrolling and what has been
// opened stay where they are.

function same(a: Node, b: Node): boolean {
  return a.nodeType === b.nodeType && a.nodeName === b.nodeName;
}

export function morph(now: Element, wanted: Element): void {
  for (const { name } of [...now.attributes])
    if (!wanted.hasAttribute(name) && name !== 'open') now.removeAttribute(name);
  for (const { name, value } of wanted.attributes)
    if (now.getAttribute(name) !== value && name !== 'open') now.setAttribute(name, value);
  const to = [...wanted.childNodes];
  to.forEach((node, i) => {
    const old = now.childNodes[i];
    if (!old) now.append(node);
    else if (!same(old, node)) old.replaceWith(node);
    else if (old instanceof Element) morph(old, node as Element);
    else if (old.nodeValue !== node.nodeValue) old.nodeValue = node.nodeValue;
  });
  while (now.childNodes.length > to.length) now.lastChild!.remove();
}
