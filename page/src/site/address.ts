// The options in the address of a page of the site, before its #: ?embed&lang=it&theme=light. The embedding code has them.
import { keepNothing } from '../core/kept';
import { language, languages, type Language } from '../core/language';
import { themeChoice, type ThemeChoice } from '../core/theme';

const isTheme = (text: string | null): text is ThemeChoice => text === 'light' || text === 'dark' || text === 'system';
const isLanguage = (text: string | null): text is Language => text !== null && text in languages;

// Returns whether the page is embedded. The options of a link are valid for this visit only; the visitor's own choices stay stored.
export function obeyAddress(search: string): boolean {
  const asked = new URLSearchParams(search);
  const [lang, theme] = [asked.get('lang'), asked.get('theme')];
  const isEmbedded = asked.has('embed');
  if (isEmbedded || isLanguage(lang) || isTheme(theme)) keepNothing();
  if (isLanguage(lang)) language.value = lang;
  if (isTheme(theme)) themeChoice.value = theme;
  return isEmbedded;
}

// The HTML code that embeds the page at `link` in another page.
export function embedCode(link: string, title: string, height: number): string {
  const address = new URL(link);
  const asked = new URLSearchParams({ lang: language.value });
  if (themeChoice.value !== 'system') asked.set('theme', themeChoice.value);
  address.search = `?embed&${asked.toString()}`;
  const text = (words: string): string => words.replaceAll('&', '&amp;').replaceAll('"', '&quot;').replaceAll('<', '&lt;');
  return `<iframe src="${text(address.href)}" title="${text(title)}" width="100%" height="${Math.round(height)}" style="border: 0" loading="lazy"></iframe>`;
}
