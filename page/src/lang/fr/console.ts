// French. The Console tab.
import type { console as en } from '../en/console';
import type { Same } from '../same';

export const console: Same<typeof en> = {
  'console.title': 'Console',
  'console.type': 'Une ligne de G-code',
  'console.send': 'Envoyer',
  'console.search': 'Chercher dans le journal',
  'console.log': 'Journal',
  'console.empty': 'Aucune entrée pour l’instant.',
  'console.nothing': 'Aucune entrée du journal ne contient ces mots.',
  'console.modes': 'Codes modaux actifs',
  'console.help': 'Les codes modaux restent actifs d’une ligne à l’autre, jusqu’à l’exécution d’un programme ou la réinitialisation de la machine. $G, $#, $$, $H et $X fonctionnent comme dans Grbl ; !\u00a0met en pause, ~\u00a0reprend. Flèche haut rappelle les lignes précédentes.',
};
