// The machines to choose from: the files in examples/machines, unchanged.
const texts: Record<string, string> = import.meta.glob('../../../examples/machines/*.toml', { query: '?raw', import: 'default', eager: true });

// What the program reports about the file of another controller.
export interface Imported {
  controller: string;
  understood: number; // values
  assumed: string[];
  unmapped: string[];
  warnings: string[];
}
export interface ChosenMachine {
  file: string;
  text: string;
  own: boolean; // the visitor's
  imported?: Imported; // from a file of another controller
}
const nameIn = (text: string): string => /^name *= *"(.*)"/m.exec(text)?.[1] ?? '';
export const examples = Object.entries(texts)
  .map(([path, text]) => ({ file: path.slice(path.lastIndexOf('/') + 1), text, name: nameIn(text) }))
  .sort((a, b) => a.name.localeCompare(b.name, 'en'));

export const usualMachine = 'router.toml';
export function exampleMachine(file: string): ChosenMachine {
  const found = examples.find((one) => one.file === file) ?? examples[0]!;
  return { file: found.file, text: found.text, own: false };
}
