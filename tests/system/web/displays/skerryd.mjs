// skerryd and skerry as child processes; SKERRYD and SKERRY name the two programs.
import { spawn } from 'node:child_process';

for (const name of ['SKERRYD', 'SKERRY']) {
  if (!process.env[name]) throw new Error(`${name} must name the program to test, such as build/bin/${name.toLowerCase()}`);
}

// Resolves with what `ready` makes of its output, once that is something; `child.end()` ends it.
export function start(program, args, ready, options = {}) {
  const child = spawn(program, args, options);
  let said = '';
  child.end = async () => {
    if (child.exitCode !== null || child.signalCode !== null) return;
    const ended = new Promise((resolve) => child.on('exit', resolve));
    child.kill('SIGTERM');
    await ended;
  };
  return new Promise((resolve, reject) => {
    child.on('error', reject);
    child.on('exit', (code) => reject(new Error(`${program} ended with ${code} before it was ready:\n${said}`)));
    for (const stream of [child.stdout, child.stderr]) {
      stream.on('data', (data) => {
        said = (said + data).slice(-8000);
        const made = ready(said);
        if (made) resolve({ child, ...made });
      });
    }
  });
}

export function startSkerryd(args = []) {
  return start(process.env.SKERRYD, ['--tcp-port', '0', '--http-port', '0', '--no-udp', '--no-cat240', '--print-ports', ...args],
    (said) => {
      const match = /tcp (\d+) http (\d+)/.exec(said);
      return match && { tcp: Number(match[1]), http: Number(match[2]) };
    });
}

export function skerry(args) {
  return new Promise((resolve, reject) => {
    const child = spawn(process.env.SKERRY, args);
    let text = '';
    for (const stream of [child.stdout, child.stderr]) stream.on('data', (data) => { text += data; });
    child.on('error', reject);
    child.on('exit', (code) => (code === 0 ? resolve(text) : reject(new Error(`skerry ${args.join(' ')}: ${code}\n${text}`))));
  });
}
