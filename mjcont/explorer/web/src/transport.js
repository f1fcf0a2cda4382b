// The client's side of a live session: requests with answers, and events; by a socket, or by a notebook's widget.

const KEY = "mjcont token";
const PROTOCOL = "mjcont";

/** Return what asks a session: request(op, args) -> a promise, on(event, listener), close(). `send` hands over. */
function transport(send, close) {
  const waiting = new Map(),
    listeners = new Map();
  let count = 0,
    over = "";
  const tell = (event, detail) => (listeners.get(event) ?? []).forEach((listener) => listener(detail));
  const end = (message) => {
    over = message;
    for (const { reject } of waiting.values()) reject(new Error(message));
    waiting.clear();
  };
  return {
    request(op, args = {}) {
      if (over) return Promise.reject(new Error(over));
      count += 1;
      const id = count;
      return new Promise((resolve, reject) => {
        waiting.set(id, { resolve, reject });
        send(JSON.stringify({ id, op, args }));
      });
    },
    on(event, listener) {
      listeners.set(event, [...(listeners.get(event) ?? []), listener]);
    },
    close,
    /** Take a message of the session. */
    take(text) {
      const message = JSON.parse(text);
      if (message.event) {
        if (message.event === "ended") end(message.message);
        return tell(message.event, message);
      }
      const { resolve, reject } = waiting.get(message.id) ?? {};
      waiting.delete(message.id);
      if (message.error) reject?.(new Error(message.error.message));
      else resolve?.(message.result);
    },
    /** Note that no more will come. */
    lost(message) {
      if (!over) {
        end(message);
        tell("close", { message });
      }
    },
  };
}

/** Return the token that the page's address brought in its fragment, which is taken from sight and kept by the tab. */
function token() {
  const given = location.hash.slice(1);
  if (given) {
    sessionStorage.setItem(KEY, given);
    history.replaceState(null, "", location.pathname);
  }
  return sessionStorage.getItem(KEY);
}

/** Connect with the server of this page; refused without its token. */
export function connect() {
  const known = token();
  if (!known) return Promise.reject(new Error("Open the whole address that mjcont printed: this one lacks its token."));
  return new Promise((resolve, reject) => {
    const socket = new WebSocket(`ws://${location.host}/socket`, [PROTOCOL, `token.${known}`]);
    const made = transport(
      (text) => socket.send(text),
      () => socket.close(),
    );
    socket.onopen = () => resolve(made);
    socket.onmessage = ({ data }) => made.take(data);
    socket.onclose = () => {
      reject(new Error("The session has ended, or this address is of another: open the one that mjcont printed."));
      made.lost("The session has ended: its server is gone. What is shown stays.");
    };
  });
}

/** Connect with a session through a notebook's widget, whose kernel hands messages on. */
export function connectWidget(model) {
  const made = transport(
    (text) => model.send({ text }),
    () => model.off("msg:custom", hear),
  );
  const hear = ({ text }) => made.take(text);
  model.on("msg:custom", hear);
  return made;
}
