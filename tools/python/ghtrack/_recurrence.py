"""The recurrence that every filter of the g-h family shares.

With T the time between updates and r the residual:

    x' = x + T v + T²/2 a,   v' = v + T a        predict
    r  = z − x'
    x = x' + g r,  v = v' + h/T r,  a = a' + 2k/T² r    update

The operations stand in the order in which the C++ filters have them, so both give the same bits.
Arguments may be numbers or arrays that broadcast.
"""


def predicted(x, dx, ddx, dt):
    """Position and velocity dt later under constant acceleration."""
    return x + dt * dx + (0.5 * dt * dt) * ddx, dx + dt * ddx


def corrected(x, dx, ddx, residual, dt, g, h, k):
    """Position, velocity and acceleration after a residual."""
    return (x + g * residual, dx + (h / dt) * residual, ddx + (2.0 * k / (dt * dt)) * residual)


def described(filter_, *names):
    """A filter as text, one attribute a line."""
    width = max(map(len, names))
    lines = [f"{type(filter_).__name__}:"]
    for name in names:
        lines.append(f"  {name:<{width}} = {getattr(filter_, name)}")
    return "\n".join(lines)
