// G-code with its kinds of words told apart, for reading alone: the page understands no program.
import type { JSX } from 'preact';

const word = /(\([^)]*\)?|;.*$)|([GgMmTt]\s*[\d.]+)|([A-Za-z#]\s*[-+]?[\d.]+)|([^;(GgMmTtA-Za-z#]+|.)/g;

export function Code({ text }: { text: string }) {
  const parts: JSX.Element[] = [];
  for (const [all, comment, code] of text.matchAll(word)) {
    const kind = comment !== undefined ? 'comment' : code !== undefined ? 'code' : '';
    parts.push(
      <span key={parts.length} class={kind}>
        {all}
      </span>,
    );
  }
  return <code>{parts}</code>;
}
