// What the daemon says.
import { told } from '../core/told';

export function Told({ words, code = '' }: { words: string; code?: string }) {
  const known = told(words);
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

export function ToldSteps({ steps }: { steps: readonly string[] }) {
  return (
    <ol class="steps">
      {steps.map((step) => (
        <li key={step}>
          <Told words={step} />
        </li>
      ))}
    </ol>
  );
}
