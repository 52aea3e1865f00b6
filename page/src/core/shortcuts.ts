// Keys that work on each page. Those that jog belong to the page "Set up" alone.
import { hold, whyNoHold } from '../machine/actions';
import { onMacroKey } from '../machine/macros';
import { startsAt } from '../machine/way_back';
import { pages } from '../pages/pages';
import { openDialog } from '../parts/view_dialog';
import { asked } from './question';
import { goTo } from './route';
import { isTyping, takesText } from './typing';

function act(event: KeyboardEvent): void {
  if (event.ctrlKey || event.altKey || event.metaKey || event.repeat) return;
  const inDialog = asked.value !== null || openDialog.value !== null || startsAt.value !== null;
  if (event.code === 'Space') {
    if (takesText(event.target)) return;
    // Where nothing moves, dialogs and choices have their space bar. A button has it nowhere: a hold by mistake costs nothing.
    if ((inDialog || isTyping(event.target)) && whyNoHold.value !== '') return;
    event.preventDefault();
    void hold();
  } else if (inDialog || isTyping(event.target)) {
    return;
  } else if (onMacroKey(event)) {
    return;
  } else if (event.key === '?') {
    openDialog.value = 'shortcuts';
  } else if (/^Digit[1-9]$/.test(event.code)) {
    const page = pages[Number(event.code.slice(5)) - 1];
    if (page !== undefined) goTo(page.path);
  }
}

export function followShortcuts(): void {
  addEventListener('keydown', act);
}
