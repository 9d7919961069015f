// Signing in at the mock server.

// As server/net/http/login_routes.cpp, but for cookies; the token is "of" the user's name.
export async function answerLogin(server, request, response) {
  let body = '';
  for await (const piece of request) body += piece;
  const reply = (status, json) => response.writeHead(status, { 'Content-Type': 'application/json' }).end(JSON.stringify(json));
  const bearer = /^Bearer of (.*)$/.exec(request.headers.authorization ?? '')?.[1];
  const ends = '2030-01-01T22:10:00Z';
  const told = (name) => {
    const user = server.users?.[name];
    return user ? { name, role: user.role, ship: user.ship, ends } : { name: `${name} (class)`, role: 'trainee', ship: server.ships[1], ends };
  };
  server.logins = [...(server.logins ?? []), { method: request.method, body, bearer }];
  const isKnown = bearer && (server.users?.[bearer] || server.classCode);
  if (request.method === 'GET') return reply(200, { users: server.users !== null, class: server.classCode !== null, ...(isKnown ? told(bearer) : {}) });
  if (request.method === 'DELETE') return reply(bearer ? 200 : 401, {});
  const { name, password, code, cookie } = JSON.parse(body);
  const isRight = code === undefined ? server.users?.[name]?.password === password : code.replace(' ', '') === server.classCode;
  if (!isRight) return reply(server.loginStatus ?? 401, {});
  return reply(200, { token: cookie && server.losesCookies ? undefined : `of ${name}`, ...told(name) });
}
