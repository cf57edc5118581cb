"""A page on 127.0.0.1."""

from __future__ import annotations

from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer


def page_server(text: str, port: int) -> ThreadingHTTPServer:
    """A server of one HTML page on 127.0.0.1; nobody else on the network can ask it.

    Args:
        port: 0 takes a free one.

    Raises:
        OSError: the port is in use.
    """
    content = text.encode()

    class Handler(BaseHTTPRequestHandler):
        """Answers every request for / with the page."""

        def do_GET(self) -> None:
            """Send the page."""
            if self.path != "/":
                self.send_error(HTTPStatus.NOT_FOUND)
                return
            self.send_response(HTTPStatus.OK)
            self.send_header("Content-Type", "text/html; charset=utf-8")
            self.send_header("Content-Length", str(len(content)))
            self.end_headers()
            self.wfile.write(content)

        def log_message(self, *_: object) -> None:
            """Say nothing."""

    return ThreadingHTTPServer(("127.0.0.1", port), Handler)
