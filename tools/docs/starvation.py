"""Write docs/validation/starvation.md: contacts behind a layer of oil by a second solution.

Half an hour of processor time; exit code 1 where a statement does not hold.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # holds `verification`

from verification.sections import STARVATION_PAGE, check_page, document, write_page
from verification.starvation.comparison import starvation

DIRECTORY = Path(__file__).parents[2] / "docs" / "validation"


def main() -> int:
    check_page(DIRECTORY, STARVATION_PAGE)
    section = starvation(quick="--quick" in sys.argv)
    write_page([section], DIRECTORY, STARVATION_PAGE)
    found = document([section])
    print("\n".join(found["messages"]) or "all statements hold")
    return 0 if found["converged"] else 1


if __name__ == "__main__":
    sys.exit(main())
