// "Check my program" as a page of its own: no server, no machine.
import { CheckPage } from '../check/CheckPage';
import { showOnSite } from './frame';

showOnSite('check', CheckPage);
