// Italian. The Console tab.
import type { console as en } from '../en/console';
import type { Same } from '../same';

export const console: Same<typeof en> = {
  'console.title': 'Console',
  'console.type': 'Una riga di G-code',
  'console.send': 'Invia',
  'console.search': 'Cerca nel registro',
  'console.log': 'Registro',
  'console.empty': 'Ancora nulla.',
  'console.nothing': 'Nessuna voce del registro contiene queste parole.',
  'console.modes': 'Codici modali attivi',
  'console.help': 'I codici modali restano attivi da una riga all’altra, finché non si esegue un programma o un reset della macchina. $G, $#, $$, $H e $X funzionano come in Grbl; !\u00a0mette in pausa, ~\u00a0riprende. Freccia su richiama le righe precedenti.',
};
