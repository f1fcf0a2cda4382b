// The client's side of a live session.

/** Return what asks the server: request(op, args), on(event, listener), close(); null where there is no server. */
export function connect() {
  return null;
}
