"""The server of the live program: bound to this computer, one page at a time, with a token."""

import asyncio
import hmac
import os
import secrets
import webbrowser
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

from aiohttp import web
from trame_client.module.vue3 import www
from trame_client.ui.html import DivLayout
from trame_server import Server
from trame_vtk.widgets.vtk import VtkLocalView

from oilfilm.postprocess.scene.live import LiveScene
from oilfilm.postprocess.scene.render_process import require_rendering

from ..runs.interrupt import print_message
from .design import Design
from .session import Session
from .workers import prepare

HOST = "127.0.0.1"
COOKIE = "oilfilm_{port}"
GRACE = 6.0  # from the end of the last page to that of the server: a page may be reloaded [s]
PATIENCE = 300.0  # for the first page to come [s]
LOOK = 0.25  # [s]
RELOAD = 2.0  # for the page before to be gone [s]
STATIC = Path(__file__).parent / "static"
POLICY = (
    "default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval' blob:; "
    "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; "
    "worker-src 'self' blob:; connect-src 'self' ws://{host} data: blob:; frame-ancestors 'none'; "
    "form-action 'self'; base-uri 'self'; object-src 'none'"
)
IN_USE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>oilfilm</title>
<body style="font: 16px/1.5 system-ui, sans-serif; max-width: 34rem; margin: 15vh auto">
<h1 style="font-size: 1.3rem">This program is open in another page</h1>
<p>It holds one design at a time. Go on here, which closes the other page, or start a second
<code>oilfilm app</code> to work on two.</p>
<p><a id="take" href="{href}">Go on in this page</a></p>
<script>document.getElementById("take").href += location.hash</script></body></html>"""
TRIGGERS = (
    *("opened", "set", "choose", "dimensions", "step", "view", "pick", "member", "click"),
    *("colour", "theme", "solve", "start_map", "take_map_point", "pin", "unpin", "swap"),
    "document",
)
# turning by the left button, moving by the middle one, zoom by the right one and the wheel
INTERACTOR = [
    {"button": 1, "action": "Rotate"},
    {"button": 2, "action": "Pan"},
    {"button": 3, "action": "Zoom", "scrollEnabled": True},
    {"button": 1, "action": "Pan", "shift": True},
    {"button": 1, "action": "Zoom", "alt": True},
]
Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


class Gate:
    """Lets in requests of one page of this computer that knows the token.

    Parameters
    ----------
    token : str
        Secret of the address.
    port : Callable
        Port of the server, known once it listens.
    coming : Callable, optional
        Called when a page is about to open.
    """

    def __init__(
        self, token: str, port: Callable[[], int], coming: Callable[[], None] = lambda: None
    ) -> None:
        self.token = token
        self.port = port
        self.coming = coming
        self.pages: list[web.Request] = []
        self.came = False

    @property
    def cookie(self) -> str:
        """Name of the cookie, which browsers share between ports."""
        return COOKIE.format(port=self.port())

    async def __call__(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        """Answer a request, or refuse it.

        Parameters
        ----------
        request : web.Request
            The request.
        handler : Callable
            What answers it.

        Returns
        -------
        web.StreamResponse
            The answer.
        """
        hosts = (f"{HOST}:{self.port()}", f"localhost:{self.port()}")
        if request.host not in hosts:
            return web.Response(status=403, text="foreign host")
        origin = request.headers.get("Origin")
        if origin is not None and origin not in [f"http://{host}" for host in hosts]:
            return web.Response(status=403, text="foreign origin")
        given = request.query.get("token") or request.cookies.get(self.cookie) or ""
        if not hmac.compare_digest(given.encode(), self.token.encode()):
            return web.Response(status=403, text="the address lacks its token: see the terminal")
        if request.path == "/ws":
            return await self._page(request, handler)
        if request.path in ("/", "/index.html"):
            return await self._first(request)
        return self._sealed(await handler(request), request.host)

    async def _page(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        """The connection of a page, as long as it lives."""
        if self.pages:
            return web.Response(status=409, text="open in another page")
        self.came = True
        self.pages.append(request)
        try:
            return await handler(request)
        finally:
            self.pages.remove(request)

    async def _first(self, request: web.Request) -> web.StreamResponse:
        """The page itself, where no other one is open."""
        waited = 0.0
        if "take" in request.query:
            for page in self.pages:
                if page.transport is not None:
                    page.transport.close()
        while self.pages and waited < RELOAD:
            await asyncio.sleep(LOOK)
            waited += LOOK
        answer: web.StreamResponse
        if self.pages:
            answer = web.Response(
                text=IN_USE.format(href=f"/?token={self.token}&take=1"), content_type="text/html"
            )
        else:
            self.coming()
            answer = web.Response(text=_index(), content_type="text/html")
        answer.set_cookie(self.cookie, self.token, httponly=True, samesite="Strict")
        return self._sealed(answer, request.host)

    @staticmethod
    def _sealed(answer: web.StreamResponse, host: str) -> web.StreamResponse:
        """Forbid the page to ask anybody but this server."""
        if not answer.prepared:
            answer.headers["Content-Security-Policy"] = POLICY.format(host=host)
            answer.headers["Referrer-Policy"] = "no-referrer"
            answer.headers["X-Content-Type-Options"] = "nosniff"
        return answer


def _index() -> str:
    """First page of trame with our title."""
    text = (Path(www) / "index.html").read_text(encoding="utf-8")
    return text.replace("trame is built by Kitware", "oilfilm")


class Program:
    """The server with its one session.

    Parameters
    ----------
    design : Design
        Design to begin with.
    port : int
        Port to listen on; 0: a free one.
    keep : bool
        The server stays when its last page is gone.
    """

    def __init__(self, design: Design, port: int, keep: bool) -> None:
        os.environ["TRAME_ARGS"] = "--server"  # trame would read our command line
        os.environ["WSLINK_READY_MSG"] = ""
        self.wanted_port = port
        self.keep = keep
        self.gate = Gate(
            secrets.token_urlsafe(16), lambda: int(self.server.port), lambda: self.session.coming()
        )
        self.server = Server("oilfilm")
        self.server.client_type = "vue3"
        self.server.enable_module({
            "serve": {"__oilfilm": str(STATIC)},
            "scripts": ["__oilfilm/app.js"],
            "styles": ["__oilfilm/style.css"],
            "vue_use": ["oilfilm"],
        })  # fmt: skip
        self.server.controller.on_server_bind.add(self._guard)
        scene = LiveScene()
        self.scene_view = VtkLocalView(
            scene.plotter.render_window,
            trame_server=self.server,
            picking_modes=("['click']",),
            click="trigger('click', [$event])",
            interactor_settings=("interactor", INTERACTOR),
        )
        self.session = Session(self.server.state, design, scene, self._push_scene)
        for name in TRIGGERS:
            self.server.trigger(name)(getattr(self.session, name))
        with DivLayout(self.server) as layout:
            page = (STATIC / "page.html").read_text(encoding="utf-8")
            layout.root.add_child(page.replace("__SCENE__", self.scene_view.html))

    @property
    def address(self) -> str:
        """Address of the page, with its token."""
        return f"http://{HOST}:{self.server.port}/?token={self.gate.token}"

    def _guard(self, server: Any) -> None:
        @web.middleware
        async def guard(request: web.Request, handler: Handler) -> web.StreamResponse:
            return await self.gate(request, handler)

        server.app.middlewares.append(guard)

    def _push_scene(self, others: bool) -> None:
        self.scene_view.update()
        if others:
            self.scene_view.push_camera()

    async def run(self, ready: Callable[[str], None]) -> None:
        """Serve until the last page is gone.

        Parameters
        ----------
        ready : Callable
            Called with the address once the server listens.
        """
        serving = asyncio.ensure_future(
            self.server.start(
                host=HOST,
                port=self.wanted_port,
                timeout=0,
                thread=True,
                open_browser=False,
                show_connection_info=False,
                disable_logging=True,
                exec_mode="coroutine",
            )
        )
        try:
            while not (self.server.running and self.server.port):
                if serving.done():
                    serving.result()
                await asyncio.sleep(0.02)
            ready(self.address)
            await self._until_nobody_is_there()
            await self.server.stop()
        finally:
            serving.cancel()
            self.session.end()

    async def _until_nobody_is_there(self) -> None:
        alone = 0.0
        while self.keep or alone < (GRACE if self.gate.came else PATIENCE):
            await asyncio.sleep(LOOK)
            alone = 0.0 if self.gate.pages else alone + LOOK


def run_app(design: Design, port: int = 0, *, browser: bool = True, keep: bool = False) -> None:
    """Serve the live program until its page is closed.

    Parameters
    ----------
    design : Design
        Design to begin with.
    port : int, default 0
        Port to listen on; 0: a free one.
    browser : bool, default True
        Open the page in the browser.
    keep : bool, default False
        Stay when the last page is gone.

    Raises
    ------
    OSError
        If the port is taken.
    """
    prepare()
    require_rendering()
    program = Program(design, port, keep)

    def ready(address: str) -> None:
        print_message(f"oilfilm app: {address}")
        if browser and not webbrowser.open(address):
            print_message("oilfilm app: no browser found here; open the address in one")

    asyncio.run(program.run(ready))
