// Classes of ships by their names in scenarios (server/world/SCENARIO.md); a test compares them with the server's.
export const OWN_SHIP_CLASSES = 'vlcc tanker container mariner ferry coaster fast_craft fishing tug pilot'.split(' ');
export const TARGET_CLASSES = [
  'boat',
  'bulker',
  'coaster',
  'container',
  'cruise',
  'dredger',
  'fast_craft',
  'fast_ferry',
  'ferry',
  'fishing',
  'mariner',
  'naval',
  'pilot',
  'product_tanker',
  'sailing',
  'tanker',
  'tug',
  'vlcc',
  'yacht',
];
