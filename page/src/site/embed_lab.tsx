// For teachers: the HTML code that embeds the current view in their own page, and the link from there to the whole Lab.
import { useState } from 'preact/hooks';
import { linkToView, view } from '../lab/state';
import { say } from '../lab/words';
import { language } from '../core/language';
import { embedCode } from './address';

const [lowest, highest] = [480, 1000]; // px

// The height of the part on this screen, within limits.
function heightOfPart(): number {
  const needed = (document.getElementById('lab-part')?.scrollHeight ?? 0) + 60;
  return Math.min(highest, Math.max(lowest, needed));
}

export function EmbedLab() {
  const [code, setCode] = useState<{ text: string; isCopied: boolean } | undefined>(undefined);
  const show = async (): Promise<void> => {
    const text = embedCode(linkToView(), `Passo Lab: ${say(`part_${view.value.part}`)}`, heightOfPart());
    const isCopied = await navigator.clipboard.writeText(text).then(
      () => true,
      () => false,
    );
    setCode({ text, isCopied });
  };
  return (
    <>
      <button type="button" class="button" onClick={() => void (code ? setCode(undefined) : show())} aria-expanded={code !== undefined}>
        {say('embed')}
      </button>
      {code && (
        <div class="lab-embed">
          <p role="status">{say(code.isCopied ? 'embedCopied' : 'embedShown')}</p>
          <textarea readOnly rows={3} aria-label={say('embed')} value={code.text} onFocus={(event) => event.currentTarget.select()} />
        </div>
      )}
    </>
  );
}

export function WholeLab() {
  const link = new URL(linkToView());
  link.search = `?lang=${language.value}`;
  return (
    <p class="lab-whole">
      <a href={link.href} target="_blank" rel="noopener">
        {say('openLab')}
      </a>
    </p>
  );
}
