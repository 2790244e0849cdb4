"""Films of every ball: a 6208 all of silicon nitride at 3000 N and 10000 r/min.

The case comes with the program. The picture shows the film over the area of each contact, and the central and minimum film of each ball.
"""

import oilfilm

result = oilfilm.run("6208_full_ceramic", points=129)
print(result)
result.plot().savefig("film_maps_6208.png")
