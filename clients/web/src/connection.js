// Connection: one WebSocket to the server, made again for as long as the page lives; where a fleet runs the exercise, to
// the host that has the radar which is watched.
//
// States: 'connecting', 'greeting' (open, no Hello yet), 'live', 'waiting' (closed, retryAt says when
// it is tried again). A server that sends nothing for SILENCE_MS is given up and called anew. Who has a token says so
// before anything else is asked.
import { answers, retryMs } from './connection_retry.js';
import { FleetPlaces } from './fleet_places.js';
import { decodeFrames, encodeClassOrder, encodeGetChartObjects, encodeGetCoastline, encodePlayback, encodeRecord, encodeSet, encodeSignIn, encodeSubscribe, encodeTargetOrder } from './messages.js';
import { signInsecure } from './insecure_sign.js';
import { token } from './token.js';

const SILENCE_MS = 6000;
// Not sent, but dropped, when so much lies unsent: settings are small, so the server has stopped reading.
const MAX_UNSENT = 65536;
// Another host is asked for a radar that nobody makes for so long.
const HOMELESS_MS = 2500;

export class Connection {
  // handlers: state(state), messages(list of server messages), garbage(WireError).
  // page: the address of a page of the server.
  constructor(page, handlers) {
    this.places = new FleetPlaces(page);
    this.handlers = handlers;
    this.state = 'waiting';
    this.attempts = 0;
    this.retryAt = 0;
    this.retry = null;     // timer of the next attempt
    this.nextRequest = 1;
    this.isServed = false;  // a subscription was answered
    this.bytes = 0;
    this.garbage = 0;
    // A page that nobody sees is given no time to retry; whoever looks at it again, or has a network again, does not wait.
    document.addEventListener('visibilitychange', () => { if (!document.hidden) this.#retryNow(); });
    addEventListener('online', () => this.#retryNow());
    this.#open();
  }

  #become(state) {
    this.state = state;
    this.handlers.state(state);
  }

  #open() {
    const socket = new WebSocket(this.places.at.ws);
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    this.#become('connecting');
    this.#listen();
    socket.onopen = () => { if (this.socket === socket) { this.#become('greeting'); this.#listen(); } };
    socket.onmessage = (event) => { if (this.socket === socket) this.#take(event.data); };
    socket.onclose = () => this.#closed(socket);
  }

  #listen() {
    clearTimeout(this.silence);
    const socket = this.socket;
    this.silence = setTimeout(() => { socket.close(); this.#closed(socket); }, SILENCE_MS);
  }

  #closed(socket) {
    if (this.socket !== socket) return;
    this.socket = null;
    clearTimeout(this.silence);
    // Where nobody greets another place may.
    if (this.state !== 'live') this.places.next();
    this.#become('waiting');
    this.#retryLater();
  }

  #retryLater() {
    const wait = retryMs(this.attempts);
    this.attempts += 1;
    this.retryAt = performance.now() + wait;
    this.retry = setTimeout(() => this.#retry(), wait);
  }

  async #retry() {
    this.retry = null;
    if (await answers(this.places.at.probe)) { this.#open(); return; }
    this.places.next();
    this.#retryLater();
  }

  #retryNow() {
    if (!this.retry) return;
    clearTimeout(this.retry);
    this.#retry();
  }

  #take(data) {
    this.#listen();
    if (!(data instanceof ArrayBuffer)) { this.#refuse(new Error('a text message')); return; }
    this.bytes += data.byteLength;
    const messages = [];
    try {
      decodeFrames(new Uint8Array(data), (message) => messages.push(message));
    } catch (error) {
      this.#refuse(error);
    }
    const hello = messages.find((m) => m.hello)?.hello;
    const fleet = messages.findLast((m) => m.fleet)?.fleet ?? (hello ? hello.fleet ?? null : undefined);
    if (fleet !== undefined) this.#takeFleet(fleet);
    if (hello) signInsecure(hello.warning);
    if (this.state === 'greeting' && hello) {
      this.attempts = 0;
      this.isServed = false;
      if (token()) this.#send((request) => encodeSignIn(request, token()));
      this.#become('live');
    }
    this.isServed ||= messages.some((m) => m.settings);
    if (this.state === 'live' && messages.length > 0) this.handlers.messages(messages);
    if (this.places.mustMove) this.#move();
  }

  #takeFleet(fleet) {
    this.places.take(fleet);
    clearTimeout(this.homeless);
    if (!this.places.isHomeless) return;
    this.homeless = setTimeout(() => {
      if (!this.places.isHomeless || this.socket === null) return;
      this.places.next();
      this.#openAnew();
    }, HOMELESS_MS);
  }

  // The radar that is watched is made on another host now.
  #move() {
    const page = this.places.pageToGoTo(location);
    if (page !== null) { location.assign(page); return; }
    this.places.move();
    this.#openAnew();
  }

  #openAnew() {
    const { socket } = this;
    this.socket = null;
    socket?.close();
    clearTimeout(this.silence);
    clearTimeout(this.retry);
    this.retry = null;
    this.#open();
  }

  // Each WebSocket message stands for itself, so after a bad one the next may be read again.
  #refuse(error) {
    this.garbage += 1;
    this.handlers.garbage(error);
  }

  #send(make) {
    if (this.socket?.readyState !== WebSocket.OPEN || this.socket.bufferedAmount > MAX_UNSENT) return null;
    const request = this.nextRequest;
    this.nextRequest = (this.nextRequest % 0xffffffff) + 1;
    this.socket.send(make(request));
    return request;
  }

  // Tells the server who the token now says one is. Where it had refused what was asked for before, and where the
  // token cannot say it (isAnew), all is asked anew.
  tellToken(isAnew = false) {
    if (this.state !== 'live') return;
    if (this.isServed && !isAnew) {
      this.#send((request) => encodeSignIn(request, token()));
      return;
    }
    const { socket } = this;
    socket.close();
    this.#closed(socket);
    this.#retryNow();
  }

  // The request number that the reply will carry, or null if it could not be sent.
  subscribe(radar, view, newView, token, options) {
    this.places.watch(options?.noSpokes ? null : radar);
    if (this.places.mustMove) { this.#move(); return null; }
    return this.#send((request) => encodeSubscribe(request, radar, view, newView, token, options));
  }

  set(radar, view, values, token) {
    return this.#send((request) => encodeSet(request, radar, view, values, token));
  }

  targetOrder(radar, view, order, token) {
    return this.#send((request) => encodeTargetOrder(request, radar, view, order, token));
  }

  // Only where Hello says hasClasses.
  classOrder(order, token) {
    return this.#send((request) => encodeClassOrder(request, order, token));
  }

  // place: { latitudeDeg, longitudeDeg, radiusNm }.
  coastline(place) {
    return this.#send((request) => encodeGetCoastline(request, place));
  }

  // place: { latitudeDeg, longitudeDeg, radiusNm, toleranceM }.
  chartObjects(place) {
    return this.#send((request) => encodeGetChartObjects(request, place));
  }

  record(record, token) {
    return this.#send((request) => encodeRecord(request, record, token));
  }

  playback(change, token) {
    return this.#send((request) => encodePlayback(request, change, token));
  }
}
