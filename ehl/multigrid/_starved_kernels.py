"""Compiled flow of a contact whose inlets carry a layer of oil: what each node passes on, in one
pass downstream; see `starved` for the equations and `_reynolds_kernels` for the layout of arrays.

A node's faces are the ones its oil leaves by: along the line, at i + 1/2, and across the lines, at
j + 1/2 or j - 1/2 by the sign of the velocity there.
"""

from ..compiled import compiled

# share of filling over which the oil that leaves a node goes over from the ratio of the velocities
# to that of the full gaps; 1.0 is as stable and 1 to 10 % less accurate, none stagnates
SPLIT_RANGE = 0.2
LEAST_FACE = 0.25  # of a node's gap, below which no extrapolated gap at a face counts


@compiled
def _poiseuille(j, i, P, eps, cx, cy):
    """d_X(eps d_X P) + d_Y(eps d_Y P) at a node."""
    s = abs(j - 1)
    e = eps[j, i]
    p = P[j, i]
    along = (eps[j, i + 1] + e) * (P[j, i + 1] - p) - (e + eps[j, i - 1]) * (p - P[j, i - 1])
    across = (eps[j + 1, i] + e) * (P[j + 1, i] - p) - (e + eps[s, i]) * (p - P[s, i])
    return cx * along + cy * across


@compiled
def march_lines(P, H, eps, flow, f, layer, hx, hy, along, residual, empty, first, stop):
    """Flux `along` through the outgoing face of every node of every second line from `first` to
    before `stop`, nothing flowing across the lines, and the residual as of full nodes; `empty` is
    one where the gap is not full.
    """
    cx, cy = 0.5 / (hx * hx), 0.5 / (hy * hy)
    for j in range(first, stop, 2):
        before = flow[j, 0] * H[j, 0]
        # the layer, where the gap is not narrower
        entering = min(flow[j, 0] * layer[j], 0.5 * (before + flow[j, 1] * H[j, 1]))
        along[j, 0] = entering
        for i in range(1, P.shape[1] - 1):
            own = flow[j, i] * H[j, i]
            full = 1.5 * own - 0.5 * before
            source = f[j, i] - _poiseuille(j, i, P, eps, cx, cy)
            rest = source + (full - entering) / hx
            if P[j, i] <= 0.0 and rest >= 0.0:
                empty[j, i] = 1
                entering = entering - hx * source
            else:
                empty[j, i] = 0
                entering = full
            along[j, i] = entering
            residual[j, i] = rest
            before = own


@compiled
def _split(total, u, v, full_x, full_y, hx, hy):
    """Share of the oil leaving a node that leaves along the line: by the velocities, and by the
    full gaps where the node is nearly full.
    """
    by_speed = u / hx / (u / hx + v / hy)
    room = full_x / hx + full_y / hy
    by_gap = full_x / hx / room
    filling = (total / room - (1.0 - SPLIT_RANGE)) / SPLIT_RANGE
    weight = min(max(filling, 0.0), 1.0)
    return by_speed + weight * (by_gap - by_speed)


@compiled
def _face(own, before):
    """Flow through a full gap at the outgoing face, from those of a node and of the one before."""
    return max(1.5 * own - 0.5 * before, LEAST_FACE * own)


@compiled
def _edge(flow, next_flow, H, next_H, layer):
    """Flux through the face behind a node of the inlet's edge: its layer, or a full gap."""
    return min(flow * layer, 0.5 * (flow * H + next_flow * next_H))


@compiled
def _enter_lines(flow, H, layer, along):
    """Set the flux that enters every line."""
    for j in range(H.shape[0]):
        along[j, 0] = _edge(flow[j, 0], flow[j, 1], H[j, 0], H[j, 1], layer[j])


@compiled
def _enter_column(i, flow, H, layer, across):
    """Set the flux that enters column i across its edge; step to the node upstream, -1 or 1."""
    up = -1 if flow[H.shape[0] // 2, i] >= 0.0 else 1
    edge = 0 if up < 0 else H.shape[0] - 1
    inner = edge - up
    across[edge, i] = _edge(
        abs(flow[edge, i]), abs(flow[inner, i]), H[edge, i], H[inner, i], layer[edge]
    )
    return up


@compiled
def _full_faces(j, i, up, flow_x, flow_y, H):
    """Flow through the full gaps at both outgoing faces of a node, along and across the lines."""
    own = H[j, i]
    return (
        _face(flow_x[j, i] * own, flow_x[j, i - 1] * H[j, i - 1]),
        _face(abs(flow_y[j, i]) * own, abs(flow_y[j + up, i]) * H[j + up, i]),
    )


@compiled
def march_columns(
    P, H, eps, flow_x, flow_y, f, layer, hx, hy, along, across, share, residual, empty
):
    """March as `march_lines`, with oil flowing across the lines, too: column after column, and
    down each of them with its flow. share: of the oil leaving each node that leaves along the
    line; zero at full nodes.
    """
    cx, cy = 0.5 / (hx * hx), 0.5 / (hy * hy)
    ny, nx = P.shape
    _enter_lines(flow_x, H, layer, along)
    for i in range(1, nx - 1):
        up = _enter_column(i, flow_y, H, layer, across)
        for step in range(1, ny - 1):
            j = step if up < 0 else ny - 1 - step
            full_x, full_y = _full_faces(j, i, up, flow_x, flow_y, H)
            entering = along[j, i - 1] / hx + across[j + up, i] / hy
            source = f[j, i] - _poiseuille(j, i, P, eps, cx, cy)
            rest = source + full_x / hx + full_y / hy - entering
            if P[j, i] <= 0.0 and rest >= 0.0:
                empty[j, i] = 1
                total = entering - source
                part = _split(total, flow_x[j, i], abs(flow_y[j, i]), full_x, full_y, hx, hy)
                along[j, i] = part * total * hx
                across[j, i] = (1.0 - part) * total * hy
                share[j, i] = part
            else:
                empty[j, i] = 0
                along[j, i] = full_x
                across[j, i] = full_y
                share[j, i] = 0.0
            residual[j, i] = rest


@compiled
def set_flux(P, H, flow_x, flow_y, lateral, hx, hy, layer, along, across):
    """Flux of a coarse grid from what was injected: that of a full gap where there is pressure,
    and no more than it elsewhere; the layer on the inlet's edge.
    """
    ny, nx = P.shape
    _enter_lines(flow_x, H, layer, along)
    if not lateral:
        for j in range(ny - 1):
            for i in range(1, nx - 1):
                full = 1.5 * flow_x[j, i] * H[j, i] - 0.5 * flow_x[j, i - 1] * H[j, i - 1]
                along[j, i] = full if P[j, i] > 0.0 else min(along[j, i], full)
        return
    for i in range(1, nx - 1):
        up = _enter_column(i, flow_y, H, layer, across)
        for j in range(1, ny - 1):
            full_x, full_y = _full_faces(j, i, up, flow_x, flow_y, H)
            total = along[j, i] / hx + across[j, i] / hy
            if P[j, i] > 0.0 or total >= full_x / hx + full_y / hy:
                along[j, i] = full_x
                across[j, i] = full_y
            else:
                part = _split(total, flow_x[j, i], abs(flow_y[j, i]), full_x, full_y, hx, hy)
                along[j, i] = part * total * hx
                across[j, i] = (1.0 - part) * total * hy


@compiled
def flux_operator(P, eps, flow_y, lateral, hx, hy, symmetric, along, across, out):
    """L(P) of given fluxes at interior nodes, zero on the edge."""
    cx, cy = 0.5 / (hx * hx), 0.5 / (hy * hy)
    ny, nx = P.shape
    out[:, :] = 0.0
    for j in range(0 if symmetric else 1, ny - 1):
        for i in range(1, nx - 1):
            leaving = (along[j, i] - along[j, i - 1]) / hx
            if lateral:
                up = -1 if flow_y[ny // 2, i] >= 0.0 else 1
                leaving += (across[j, i] - across[j + up, i]) / hy
            out[j, i] = _poiseuille(j, i, P, eps, cx, cy) - leaving


@compiled
def march_change(gained, own, speed, empty, turn, hx, first, along, content, rows):
    """Change of the flux `along` from that of its first column on, of the oil of every node, and
    of the rows of full nodes; gained: change of the Poiseuille term less that of f; own: of rho u
    H; turn: i omega.
    """
    for j in range(first, own.shape[0] - 1):
        before = own[j, 0]
        entering = along[j, 0]
        for i in range(1, own.shape[1] - 1):
            u = speed[j, i]
            if empty[j, i]:
                # half a mesh at a meniscus belongs to the next node, too
                half = 0.0 if empty[j, i + 1] else 0.5 * own[j, i] / u
                leaving = entering + hx * (gained[j, i] + turn * half)
                leaving = leaving / (1.0 + turn * hx / u)
                content[j, i] = leaving / u - half
            else:
                leaving = 1.5 * own[j, i] - 0.5 * before
                content[j, i] = own[j, i] / u
                rows[j, i] = gained[j, i] - (leaving - entering) / hx - turn * content[j, i]
            along[j, i] = leaving
            entering = leaving
            before = own[j, i]
