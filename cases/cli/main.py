"""The commands of `oilfilm`; importing it registers them in the order of the help."""

from .terminal import app  # isort: skip
from . import compute  # noqa: F401  # isort: skip
from . import over_time  # noqa: F401  # isort: skip
from . import batch  # noqa: F401  # isort: skip
from . import optimise  # noqa: F401  # isort: skip
from . import documents  # noqa: F401  # isort: skip
from . import quick  # noqa: F401  # isort: skip
from . import files  # noqa: F401  # isort: skip
from . import verify  # noqa: F401  # isort: skip

__all__ = ["app"]
