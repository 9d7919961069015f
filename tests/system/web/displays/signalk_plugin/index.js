// A Signal K server plugin that offers skerryd's radars: control by REST, spokes and deltas by WebSocket.
const WebSocket = require('ws');

module.exports = (app) => {
  const plugin = { id: 'skerry-radar', name: 'Skerry radar' };
  const sockets = [];
  let base = '';

  const radars = () => `${base}/signalk/v2/api/vessels/self/radars`;
  const get = async (path) => {
    const answer = await fetch(`${radars()}${path}`);
    return answer.ok ? answer.json() : null;
  };
  const info = async (id) => ({ id, ...await get(`/${id}`) });

  // Hands on what comes from a WebSocket of skerryd.
  function follow(path, onOpen, onMessage) {
    const socket = new WebSocket(base.replace(/^http/, 'ws') + path);
    sockets.push(socket);
    socket.on('open', () => onOpen(socket));
    socket.on('message', onMessage);
    socket.on('error', (error) => app.error(`${path}: ${error.message}`));
  }

  const methods = {
    getRadars: async () => Object.keys((await get('')).radars),
    getRadarInfo: info,
    getCapabilities: (id) => get(`/${id}/capabilities`),
    getState: (id) => get(`/${id}/state`),
    getControl: async (id, control) => (await get(`/${id}/controls/${control}`))?.value,
    setControl: async (id, control, value) => {
      const body = typeof value === 'object' ? value : { value };
      const answer = await fetch(`${radars()}/${id}/controls/${control}`, { method: 'PUT', body: JSON.stringify(body) });
      const { message } = await answer.json();
      return answer.ok ? { success: true } : { success: false, error: message };
    },
  };

  plugin.start = async ({ url }) => {
    base = url;
    app.radarApi.register(plugin.id, { name: plugin.name, methods });
    for (const id of await methods.getRadars()) {
      follow(`/signalk/v2/api/vessels/self/radars/${id}/spokes`, () => {},
        (data) => app.binaryStreamManager.emitData(`radars/${id}`, data));
    }
    follow('/signalk/v1/stream?subscribe=none',
      (socket) => socket.send(JSON.stringify({ context: 'vessels.self', subscribe: [{ path: 'navigation.*', period: 500 }] })),
      (text) => {
        const message = JSON.parse(text);
        if (message.updates) app.handleMessage(plugin.id, { ...message, updates: message.updates.map(({ values }) => ({ values })) });
      });
  };
  plugin.stop = () => {
    for (const socket of sockets.splice(0)) socket.terminate();
  };
  plugin.schema = { type: 'object', properties: { url: { type: 'string', title: 'Address of skerryd' } } };
  return plugin;
};
