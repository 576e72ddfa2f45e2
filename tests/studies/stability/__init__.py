"""1,015 stiff and extreme scenes, each watched by a second model: `make stability`."""
