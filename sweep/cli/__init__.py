"""The command line: `verbs` has one function for each verb, `terminal` the output on a terminal.

Longer verbs have files of their own, such as `run`. `question` reads the question of a ranking,
`find_case` and `named_files` find the case or the file that a user names, `place` says where cases
run, `refusals` lists the errors that end the program with their text, `completion` is for shells.
"""
