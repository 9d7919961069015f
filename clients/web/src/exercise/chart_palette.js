// Colours of the chart. Those of the controls around it stand in common.css, by the same names.
export const CHART_PALETTES = {
  day: {
    water: '#0d2230', land: '#4a4531', shore: '#9c9068', grid: '#1d3a4a', gridText: '#7fa2b3', own: '#4fe3ff', target: '#d8e6dc', sart: '#ff6b9d',
    chosen: '#ffd23c', warn: '#ff9d3c', route: '#d78bff', track: '#7d9a8a', ownTrack: '#3a93a8', rain: '#5f8fd8', label: '#dbe6ea', halo: '#0d2230', plan: '#ffd23c',
  },
  dusk: {
    water: '#08151e', land: '#2e2b1f', shore: '#6a6247', grid: '#122732', gridText: '#587381', own: '#37bad2', target: '#a6b4ab', sart: '#c94f78',
    chosen: '#d2a92c', warn: '#d47f2e', route: '#a567c8', track: '#57705f', ownTrack: '#2a6b7b', rain: '#43669c', label: '#a0b0b7', halo: '#08151e', plan: '#d2a92c',
  },
  night: {
    water: '#03080c', land: '#15140e', shore: '#383426', grid: '#0b171e', gridText: '#3c515b', own: '#2193a8', target: '#6f7d74', sart: '#8f3352',
    chosen: '#a8841e', warn: '#a8601c', route: '#75478f', track: '#38493f', ownTrack: '#1c4a55', rain: '#2b4469', label: '#6c7c83', halo: '#03080c', plan: '#a8841e',
  },
};
