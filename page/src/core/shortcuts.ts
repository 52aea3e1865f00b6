// Keys that work on each page. Those that jog belong to the page "Set up" alone.
import { hold } from '../machine/actions';
import { pages } from '../pages/pages';
import { openDialog } from '../parts/view_dialog';
import { asked } from './question';
import { goTo } from './route';
import { isTyping } from './typing';

function act(event: KeyboardEvent): void {
  if (event.ctrlKey || event.altKey || event.metaKey || event.repeat || isTyping(event.target)) return;
  if (asked.value !== null || openDialog.value !== null) return;
  if (event.key === '?') {
    openDialog.value = 'shortcuts';
  } else if (event.code === 'Space') {
    // Also where a button has the focus: a hold by mistake costs nothing.
    event.preventDefault();
    void hold();
  } else if (/^Digit[1-9]$/.test(event.code)) {
    const page = pages[Number(event.code.slice(5)) - 1];
    if (page !== undefined) goTo(page.path);
  }
}

export function followShortcuts(): void {
  addEventListener('keydown', act);
}
