// When a lost server is asked for again. It is asked by fetch, and the WebSocket is opened once it answers: browsers hold
// back WebSockets of a page by up to 5 s after some twenty that failed, but fetches they do not. Spread, so that a room
// full of consoles does not call all at once.
export const FIRST_RETRY_MS = 300, LAST_RETRY_MS = 1600;
const ANSWER_MS = 3000;

// Milliseconds until the next attempt, 0.75 to 1.25 times the middle: at most 2 s.
export function retryMs(attempts, random = Math.random()) {
  return Math.min(LAST_RETRY_MS, FIRST_RETRY_MS * 2 ** attempts) * (0.75 + 0.5 * random);
}

// Whether the server answers now; any answer is one.
export async function answers(url) {
  try {
    await fetch(url, { cache: 'no-store', mode: 'no-cors', signal: AbortSignal.timeout(ANSWER_MS) });
    return true;
  } catch {
    return false;
  }
}
