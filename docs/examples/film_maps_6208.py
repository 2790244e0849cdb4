"""Films of every ball: a 6208 all of silicon nitride at 3000 N and 10000 r/min.

The case comes with the program. Of each contact there is the film over its area, with the thinnest place marked.
"""

import oilfilm

result = oilfilm.run("6208_full_ceramic", points=129)
print(result)
result.plot().savefig("film_maps_6208.png")
