// Colours of the chart and of lines of one's own, by palette. Tones that echoes do not have; red and green are those of buoys,
// which their shapes tell too.
const colours = (coast, shoal, deep, text, buoy, mine, mob) => ({ coast, shoal, deep, text, buoy, mine, mob });

export const CHART_COLOURS = {
  day: colours('#b8a27a', '#6ea3e0', '#3f648f', '#9fb9d6',
    { red: '#ef6a62', green: '#4fc06e', yellow: '#e2c84a', black: '#8f9aa0', white: '#e4e9eb', plain: '#b9c3c7', danger: '#c9a0dc', light: '#e08be8' },
    { note: '#e8edef', track: '#5fd7a2', limit: '#e08be8', danger: '#ffb547', event: '#7fb4ff' }, '#ff5a4a'),
  dusk: colours('#8d7c5e', '#4f7db0', '#2f4d70', '#7790ab',
    { red: '#bf534d', green: '#3d9656', yellow: '#b09b3a', black: '#6b757a', white: '#b3babd', plain: '#8e979b', danger: '#9a7aab', light: '#ad6bb3' },
    { note: '#b9c2c5', track: '#49a87f', limit: '#ad6bb3', danger: '#cc913a', event: '#6390cc' }, '#e24d3f'),
  night: colours('#54492f', '#2b4a70', '#1b3049', '#475a70',
    { red: '#7d322e', green: '#265f36', yellow: '#6e6124', black: '#41484b', white: '#71787a', plain: '#565d60', danger: '#5f4a6b', light: '#6c4170' },
    { note: '#747c7f', track: '#2d6b50', limit: '#6c4170', danger: '#825b22', event: '#3d5b83' }, '#c23c30'),
};
