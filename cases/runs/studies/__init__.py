"""Further answers on a case.

| module | responsibility |
|---|---|
| atlas | films of the film atlas, of a contact or of a bearing |
| stiffness | stiffness over speed |
| temperatures | temperatures over the speed up to the limit, and over time |
| transient | a contact over time, its steps kept while it runs |
| vibration | vibration of a bearing |
| kept_steps | the folder of these steps |
| supply | torque at other supplies of oil, films after the supply stops |

atlas        - films of a case by the film atlas, without a film solve
kept_steps   - steps of a contact over time on disk while it runs, so that an interrupted run goes
               on
stiffness    - run the stiffness of a case over the speed of its inner ring
supply       - effects of the oil supply beside the torque
temperatures - run the temperatures of a case over the speed, and over time from a start on
transient    - run of a contact over time
vibration    - run the vibration of a bearing case
"""
