// The frame of a page of the site: the link to the manual, the language, the theme. An embedded page has no frame.
import { render } from 'preact';
import type { ComponentType } from 'preact';
import { followLanguage, language, languages, say, type Language } from '../core/language';
import { followRoute } from '../core/route';
import { followTheme, themeChoice, type ThemeChoice } from '../core/theme';
import { obeyAddress } from './address';
import '../style/theme.css';
import '../style/parts.css';
import './site.css';

function Head() {
  return (
    <header class="site-head">
      <a class="site-name" href="../index.html">
        Passo
      </a>
      <label>
        <span class="unseen">{say('view.language')}</span>
        <select value={language.value} onChange={(event) => (language.value = event.currentTarget.value as Language)}>
          {Object.entries(languages).map(([name, words]) => (
            <option key={name} value={name} lang={name}>
              {words}
            </option>
          ))}
        </select>
      </label>
      <label>
        <span class="unseen">{say('view.theme')}</span>
        <select value={themeChoice.value} onChange={(event) => (themeChoice.value = event.currentTarget.value as ThemeChoice)}>
          {(['system', 'dark', 'light'] as const).map((one) => (
            <option key={one} value={one}>
              {say(`view.theme.${one}`)}
            </option>
          ))}
        </select>
      </label>
    </header>
  );
}

// `path`: the page's name behind #, as in the web interface, so that a link is the same in both.
export function showOnSite(path: string, Content: ComponentType<{ embedded: boolean }>): void {
  const embedded = obeyAddress(location.search);
  followTheme();
  followLanguage();
  followRoute(path);
  const place = document.getElementById('page');
  if (place === null) return;
  render(
    <div class={`site ${embedded ? 'embedded' : ''}`}>
      {!embedded && <Head />}
      <main class={`site-content page-${path}`}>
        <Content embedded={embedded} />
      </main>
    </div>,
    place,
  );
}
