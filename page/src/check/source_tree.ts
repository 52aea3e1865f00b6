// The configuration files of other controllers as trees (src/machine/machine_import/include/passo/machine_import/source_tree.hpp).
// YAML and XML have no library in WebAssembly: JavaScript reads them, and the module maps the tree.
import { isAlias, isMap, isScalar, isSeq, LineCounter, parseDocument, type Document, type Node } from 'yaml';

export interface SourceNode {
  name: string;
  text: string;
  children: SourceNode[];
  line: number;
  column: number;
}
export const mostSourceBytes = 1 << 20;
const mostNodes = 50_000;
const deepest = 32;

const nodeOf = (name: string): SourceNode => ({ name, text: '', children: [], line: 0, column: 0 });
const nested = 'it has more than 50,000 values, or they are nested more than 32 deep';

// Throws with words where the text is no YAML.
export function treeOfYaml(text: string): SourceNode {
  const lines = new LineCounter();
  // As text alone: whether 010 is a number is not for the parser to say.
  // Nor does FluidNC need the blank after a key: "pulloff_mm:1.000".
  const spaced = text.replace(/^( *\w+):(?=[^\s:])/gm, '$1: ');
  const document = parseDocument(spaced, { schema: 'failsafe', lineCounter: lines, uniqueKeys: false, logLevel: 'silent' });
  const wrong = document.errors[0];
  if (wrong !== undefined) throw new Error(wrong.message);
  let nodes = 0;
  const add = (node: Node | null, into: SourceNode, depth: number): void => {
    if (++nodes > mostNodes || depth > deepest) throw new Error(nested);
    if (node === null) return;
    const meant: Node | undefined | null = isAlias(node) ? node.resolve(document as Document) : node;
    if (meant == null) return;
    const place = meant.range == null ? null : lines.linePos(meant.range[0]);
    if (place !== null) [into.line, into.column] = [place.line, place.col];
    if (isScalar(meant)) into.text = String(meant.value ?? '');
    if (isSeq(meant)) {
      for (const item of meant.items) {
        const child = nodeOf('');
        into.children.push(child);
        add(item as Node | null, child, depth + 1);
      }
    }
    if (isMap(meant)) {
      for (const { key, value } of meant.items) {
        const child = nodeOf(isScalar(key) ? String(key.value ?? '') : '');
        into.children.push(child);
        add(value as Node | null, child, depth + 1);
      }
    }
  };
  const root = nodeOf('');
  add(document.contents, root, 0);
  return root;
}

// The DOM does not tell where an element stands.
export function treeOfXml(text: string): SourceNode {
  if (/<!ENTITY/i.test(text)) throw new Error('the file declares an entity');
  const document = new DOMParser().parseFromString(text, 'text/xml');
  const wrong = document.querySelector('parsererror');
  if (wrong !== null) throw new Error(wrong.textContent?.trim().split('\n')[0] ?? 'this is not XML');
  let nodes = 0;
  const add = (element: Element, depth: number): SourceNode => {
    if (++nodes > mostNodes || depth > deepest) throw new Error(nested);
    const node = nodeOf(element.tagName);
    for (const child of element.children) node.children.push(add(child, depth + 1));
    if (node.children.length === 0) node.text = element.textContent ?? '';
    return node;
  };
  return add(document.documentElement, 0);
}

// Bytes of a file as text. Windows writes the texts of Mach3 in its own code page, without saying so.
export function decoded(bytes: ArrayBuffer): string {
  try {
    return new TextDecoder('utf-8', { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder('windows-1252').decode(bytes);
  }
}
