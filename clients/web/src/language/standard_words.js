// Abbreviations that are the same in every language: IEC 62288 has them in English, and mariners read them so; units and hemispheres
// likewise. They are not in the files of languages.
const WORDS = new Set([
  'AIS', 'BCR', 'BCT', 'C', 'CPA', 'E', 'EBL', 'GAIN', 'GND', 'H', 'HDG', 'IR', 'MMSI', 'MOB', 'N', 'NO', 'PI', 'POS', 'R', 'RAIN', 'RM', 'S', 'SEA', 'SPD', 'STAB', 'STBY',
  'T', 'TCPA', 'TM', 'TTG', 'TUNE', 'TX', 'UP', 'UTC', 'VECT', 'VRM', 'W', 'WATER',
  'B', 'GB', 'Hz', 'MB', 'NM', 'TB', 'dB', 'deg', 'h', 'kB', 'kn', 'm', 'min', 'mm', 'rpm', 's', '\u00b5s',
  'Skerry',
]);

// Whether a text has nothing else, whatever its numbers and signs are: 'EBL 1', '15 s', '350-10'.
export const isStandard = (text) => (text.match(/\p{L}+/gu) ?? []).every((word) => WORDS.has(word));
