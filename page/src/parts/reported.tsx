// What the server reports. What the page cannot translate is marked as English.
import { reportIn, type Report } from '../core/faults';

export function Reported({ words, sentence, code = '' }: Report & { code?: string }) {
  const known = reportIn({ words, sentence });
  return (
    <>
      <span lang={known === null ? 'en' : undefined}>{known ?? words}</span>
      {code !== '' && (
        <>
          {' '}
          <code class="dim">{code}</code>
        </>
      )}
    </>
  );
}

export function Steps({ steps }: { steps: readonly Report[] }) {
  return (
    <ol class="steps">
      {steps.map((step) => (
        <li key={step.words}>
          <Reported {...step} />
        </li>
      ))}
    </ol>
  );
}
