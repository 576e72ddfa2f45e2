"""The command line: `verbs` has one function for each verb, `terminal` what a terminal shows.

Longer verbs have files of their own, such as `run`. `question` reads what a ranking is asked,
`find_case` the case that is named, `cluster` where cases run, `refusals` lists the errors that end
the program with their text, `completion` is for shells.
"""
