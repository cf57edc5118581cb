"""A host on this machine, well-behaved and not."""

import contextlib
import http.server
import threading
import time

CONTENT = b"what was asked for"


class _Handler(http.server.BaseHTTPRequestHandler):
    """Serves CONTENT at /content, is silent at /silent, and breaks off at /broken."""

    def do_GET(self):
        if self.path == "/silent":
            time.sleep(3)
        self.send_response(404 if self.path == "/gone" else 200)
        self.send_header("Content-Length", str(len(CONTENT) + (self.path == "/broken")))
        self.end_headers()
        self.wfile.write(CONTENT)

    def log_message(self, *_):
        pass


@contextlib.contextmanager
def serving():
    """The address of the host for as long as it is wanted."""
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), _Handler) as server:
        server.daemon_threads = True
        server.block_on_close = False
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()
